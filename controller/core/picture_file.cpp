// SPDX-License-Identifier: Apache-2.0
#include "controller/core/picture_file.h"

#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfInputFile.h>
#include <ImfOutputFile.h>
#include <fstream>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <utility>

#include "controller/core/picture_header.h"

namespace chiaro::core {
namespace {

Problem refusal(const std::string& name, const std::string& what, const std::string& remedy) {
  return {{name, 0, 0}, what, remedy};
}

cv::Mat eight_bit_colour(cv::Mat picture) {
  if (picture.depth() == CV_16U) picture.convertTo(picture, CV_8U, 1 / 257.0);
  if (picture.depth() != CV_8U) picture.convertTo(picture, CV_8U, 255.0);
  cv::Mat colour;
  if (picture.channels() == 1) {
    cv::cvtColor(picture, colour, cv::COLOR_GRAY2RGB);
  } else if (picture.channels() == 4) {
    // Transparent pixels show mid grey: neither light nor dark pulls at the measures.
    cv::cvtColor(picture, colour, cv::COLOR_BGRA2RGB);
    for (int y = 0; y < picture.rows; ++y)
      for (int x = 0; x < picture.cols; ++x) {
        const int alpha = picture.at<cv::Vec4b>(y, x)[3];
        auto& c = colour.at<cv::Vec3b>(y, x);
        for (int k = 0; k < 3; ++k)
          c[k] = static_cast<std::uint8_t>((c[k] * alpha + 119 * (255 - alpha)) / 255);
      }
  } else {
    cv::cvtColor(picture, colour, cv::COLOR_BGR2RGB);
  }
  return colour;
}

cv::Mat bgr(const EncodedPicture& picture) {
  cv::Mat out(picture.size.height, picture.size.width, CV_8UC3);
  for (std::size_t i = 0; i < picture.values.size(); ++i) {
    const auto& v = picture.values[i];
    out.data[3 * i] = v[2];
    out.data[3 * i + 1] = v[1];
    out.data[3 * i + 2] = v[0];
  }
  return out;
}

Result<Done> write_bytes(const std::filesystem::path& file,
                         const std::vector<std::uint8_t>& bytes) {
  std::ofstream out(file, std::ios::binary | std::ios::trunc);
  out.write(reinterpret_cast<const char*>(bytes.data()),
            static_cast<std::streamsize>(bytes.size()));
  out.close();
  if (!out)
    return refusal(file.string(), "cannot write this file",
                   "is the folder there and writable, and the disk not full?");
  return Done{};
}

struct NamedPlane {
  const char* name;
  const Plane* plane;
};

Result<Done> write_planes(const std::filesystem::path& file,
                          std::span<const NamedPlane> planes) try {
  const Size size = planes[0].plane->size;
  Imf::Header header(size.width, size.height);
  Imf::FrameBuffer buffer;
  for (const NamedPlane& p : planes) {
    header.channels().insert(p.name, Imf::Channel(Imf::FLOAT));
    // The library's interface takes a mutable pointer for reading too.
    buffer.insert(
        p.name,
        Imf::Slice(Imf::FLOAT, reinterpret_cast<char*>(const_cast<float*>(p.plane->values.data())),
                   sizeof(float), sizeof(float) * static_cast<std::size_t>(size.width)));
  }
  Imf::OutputFile out(file.string().c_str(), header);
  out.setFrameBuffer(buffer);
  out.writePixels(size.height);
  return Done{};
} catch (const std::exception& error) {
  return refusal(file.string(), std::string("cannot write this OpenEXR file: ") + error.what(),
                 "is the folder there and writable, and the disk not full?");
}

}  // namespace

Result<EncodedPicture> decode_picture(std::span<const std::uint8_t> bytes,
                                      const std::string& name) try {
  if (auto problem = header_problem(bytes, name)) return *std::move(problem);
  const cv::Mat raw(1, static_cast<int>(bytes.size()), CV_8U,
                    const_cast<std::uint8_t*>(bytes.data()));
  // Without IMREAD_UNCHANGED OpenCV turns the picture upright by its EXIF tag, with it alpha is
  // kept: try the first for JPEG (which has no alpha), the second for the rest.
  const bool jpeg = bytes.size() > 2 && bytes[0] == 0xff && bytes[1] == 0xd8;
  cv::Mat picture = cv::imdecode(raw, jpeg ? cv::IMREAD_COLOR : cv::IMREAD_UNCHANGED);
  if (picture.empty())
    return refusal(name,
                   "this is not a picture that can be read (damaged, cut short, or another format)",
                   "export it as PNG or JPEG");
  if (static_cast<std::size_t>(picture.rows) * static_cast<std::size_t>(picture.cols) > kMostPixels)
    return refusal(name, "the picture is too large", "make it smaller: 2 megapixels are plenty");
  // The common kind is turned round in place: fifty megapixels are 150 MB a copy.
  const cv::Mat colour =
      picture.type() == CV_8UC3 ? picture : eight_bit_colour(std::exchange(picture, {}));
  const bool reversed = !picture.empty();
  EncodedPicture out({colour.cols, colour.rows});
  for (int y = 0; y < colour.rows; ++y) {
    const std::uint8_t* from = colour.ptr<std::uint8_t>(y);
    for (auto* to = out.row(y); to != out.row(y) + colour.cols; ++to, from += 3)
      *to =
          reversed ? std::array{from[2], from[1], from[0]} : std::array{from[0], from[1], from[2]};
  }
  return out;
} catch (const std::exception& error) {
  return refusal(name, std::string("the picture cannot be read: ") + error.what(),
                 "export it as PNG or JPEG");
}

Result<EncodedPicture> read_picture(const std::filesystem::path& file) {
  std::error_code code;
  const auto size = std::filesystem::file_size(file, code);
  if (code || !std::filesystem::is_regular_file(file))
    return refusal(file.string(), "there is no such picture", "check the path");
  if (size > (512u << 20))
    return refusal(file.string(), "the file is larger than 512 MiB", "export it smaller");
  std::vector<std::uint8_t> bytes(size);
  std::ifstream in(file, std::ios::binary);
  in.read(reinterpret_cast<char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
  if (!in) return refusal(file.string(), "the picture cannot be read", "check its permissions");
  return decode_picture(bytes, file.string());
}

Picture linear_at_most(const EncodedPicture& picture, std::size_t pixels) {
  int step = 1;
  while (picture.size.pixels() / (static_cast<std::size_t>(step) * static_cast<std::size_t>(step)) >
         pixels)
    ++step;
  if (step == 1) return linear(picture);
  std::array<float, 256> light{};
  for (int i = 0; i < 256; ++i)
    light[static_cast<std::size_t>(i)] = static_cast<float>(srgb_linear(i / 255.0));
  const Size size{std::max(1, picture.size.width / step), std::max(1, picture.size.height / step)};
  Picture out(size);
  const float share = 1.0f / static_cast<float>(step * step);
  for (int y = 0; y < size.height; ++y)
    for (int x = 0; x < size.width; ++x) {
      std::array<float, 3> sum{};
      for (int dy = 0; dy < step; ++dy)
        for (int dx = 0; dx < step; ++dx) {
          const auto& c = picture.at(std::min(x * step + dx, picture.size.width - 1),
                                     std::min(y * step + dy, picture.size.height - 1));
          for (std::size_t k = 0; k < 3; ++k) sum[k] += light[c[k]];
        }
      out.red.at(x, y) = share * sum[0];
      out.green.at(x, y) = share * sum[1];
      out.blue.at(x, y) = share * sum[2];
    }
  return out;
}

std::vector<std::uint8_t> encode_png(const EncodedPicture& picture) {
  std::vector<std::uint8_t> bytes;
  cv::imencode(".png", bgr(picture), bytes);
  return bytes;
}

std::vector<std::uint8_t> encode_jpeg(const EncodedPicture& picture, int quality) {
  std::vector<std::uint8_t> bytes;
  cv::imencode(".jpg", bgr(picture), bytes, {cv::IMWRITE_JPEG_QUALITY, quality});
  return bytes;
}

Result<Done> write_png(const std::filesystem::path& file, const EncodedPicture& picture) {
  return write_bytes(file, encode_png(picture));
}

Result<Done> write_png(const std::filesystem::path& file, const Grid<std::uint16_t>& ids) {
  const cv::Mat grey(ids.size.height, ids.size.width, CV_16U,
                     const_cast<std::uint16_t*>(ids.values.data()));
  std::vector<std::uint8_t> bytes;
  cv::imencode(".png", grey, bytes);
  return write_bytes(file, bytes);
}

Result<Done> write_exr(const std::filesystem::path& file, const Picture& picture) {
  const NamedPlane planes[] = {{"R", &picture.red}, {"G", &picture.green}, {"B", &picture.blue}};
  return write_planes(file, planes);
}

Result<Done> write_exr(const std::filesystem::path& file, const Plane& depth) {
  const NamedPlane planes[] = {{"Z", &depth}};
  return write_planes(file, planes);
}

Result<Picture> read_exr(const std::filesystem::path& file) try {
  Imf::InputFile in(file.string().c_str());
  const auto window = in.header().dataWindow();
  const Size size{window.max.x - window.min.x + 1, window.max.y - window.min.y + 1};
  if (size.width <= 0 || size.height <= 0 || size.pixels() > kMostPixels)
    return refusal(file.string(), "the OpenEXR picture has no pixels or too many",
                   "export it at a usual size");
  Picture out(size);
  Imf::FrameBuffer buffer;
  const std::ptrdiff_t shift =
      -window.min.x - static_cast<std::ptrdiff_t>(window.min.y) * size.width;
  for (const auto& [name, plane] : {std::pair{"R", &out.red}, {"G", &out.green}, {"B", &out.blue}})
    buffer.insert(name,
                  Imf::Slice(Imf::FLOAT, reinterpret_cast<char*>(plane->values.data() + shift),
                             sizeof(float), sizeof(float) * static_cast<std::size_t>(size.width)));
  in.setFrameBuffer(buffer);
  in.readPixels(window.min.y, window.max.y);
  return out;
} catch (const std::exception& error) {
  return refusal(file.string(), std::string("this OpenEXR file cannot be read: ") + error.what(),
                 "export it again");
}

}  // namespace chiaro::core
