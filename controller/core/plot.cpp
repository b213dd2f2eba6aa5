// SPDX-License-Identifier: Apache-2.0
#include "controller/core/plot.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

namespace chiaro::core {
namespace {

// Okabe and Ito's palette, darkest first: told apart by every kind of colour vision.
constexpr const char* kColours[] = {"#0072b2", "#d55e00", "#009e73", "#cc79a7",
                                    "#e69f00", "#56b4e9", "#000000", "#8a6d3b"};
constexpr double kLeft = 78, kTop = 48, kBottom = 58, kRight = 24;

std::string num(double value, const char* format = "%.6g") {
  char text[40];
  std::snprintf(text, sizeof text, format, value);
  return text;
}
std::string px(double value) { return num(value, "%.1f"); }

std::string escaped(const std::string& text) {
  std::string out;
  for (const char c : text) switch (c) {
      case '<':
        out += "&lt;";
        break;
      case '>':
        out += "&gt;";
        break;
      case '&':
        out += "&amp;";
        break;
      case '"':
        out += "&quot;";
        break;
      default:
        out += c;
    }
  return out;
}

std::string text_at(double x, double y, const std::string& text, const char* anchor,
                    const std::string& more = "") {
  return "<text x=\"" + px(x) + "\" y=\"" + px(y) + "\" text-anchor=\"" + anchor + "\"" + more +
         ">" + escaped(text) + "</text>\n";
}

std::string line_at(double x1, double y1, double x2, double y2, const std::string& stroke) {
  return "<line x1=\"" + px(x1) + "\" y1=\"" + px(y1) + "\" x2=\"" + px(x2) + "\" y2=\"" + px(y2) +
         "\" stroke=\"" + stroke + "\"/>\n";
}

/// A range of data mapped to a range of pixels.
struct Scale {
  double least = 0, most = 1, from = 0, to = 1;
  bool log = false;
  double forward(double v) const { return log ? std::log10(v) : v; }
  bool shows(double v) const { return std::isfinite(v) && (!log || v > 0); }
  double at(double v) const {
    return from + (to - from) * (forward(v) - forward(least)) / (forward(most) - forward(least));
  }
};

double round_step(double span, int about) {
  const double raw = span / about, power = std::pow(10.0, std::floor(std::log10(raw)));
  for (const double k : {1.0, 2.0, 2.5, 5.0})
    if (k * power >= raw) return k * power;
  return 10 * power;
}

std::vector<double> ticks(const Scale& scale, int about) {
  std::vector<double> out;
  if (scale.log) {
    const double low = std::ceil(std::log10(scale.least) - 1e-9),
                 high = std::floor(std::log10(scale.most) + 1e-9);
    const double step = std::max(1.0, std::ceil((high - low) / about));
    for (double e = low; e <= high + 1e-9; e += step) out.push_back(std::pow(10.0, e));
    if (out.size() >= 2) return out;
    out.clear();
    for (double e = std::floor(std::log10(scale.least)); e <= high + 1; ++e)
      for (const double k : {1.0, 2.0, 5.0})
        if (const double v = k * std::pow(10.0, e); v >= scale.least && v <= scale.most)
          out.push_back(v);
    return out;
  }
  const double step = round_step(scale.most - scale.least, about);
  for (double k = std::ceil(scale.least / step - 1e-9); k * step <= scale.most + 1e-9 * step; ++k)
    out.push_back(k == 0 ? 0 : k * step);
  return out;
}

/// The range of the values, a little widened; what the axis says wins.
Scale scale_for(const Axis& axis, const std::vector<double>& values, bool from_zero) {
  Scale scale;
  scale.log = axis.log;
  double low = 1e300, high = -1e300;
  for (const double v : values)
    if (scale.shows(v)) low = std::min(low, v), high = std::max(high, v);
  if (low > high) low = axis.log ? 1 : 0, high = axis.log ? 10 : 1;
  if (axis.log) {
    scale.least = low / 1.3, scale.most = high * 1.3;
  } else {
    if (from_zero) low = std::min(low, 0.0), high = std::max(high, 0.0);
    const double room = high > low ? 0.05 * (high - low) : 0.5 + 0.05 * std::abs(high);
    scale.least = from_zero && low == 0 ? 0 : low - room;
    scale.most = high + room;
  }
  scale.least = axis.least.value_or(scale.least);
  scale.most = axis.most.value_or(scale.most);
  if (scale.log && scale.least <= 0) scale.least = scale.most / 1e6;
  if (!(scale.most > scale.least)) scale.most = scale.least + 1;
  return scale;
}

std::string head(int width, int height, const std::string& title) {
  return "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"" + std::to_string(width) +
         "\" height=\"" + std::to_string(height) + "\" viewBox=\"0 0 " + std::to_string(width) +
         " " + std::to_string(height) +
         "\" font-family=\"Helvetica, Arial, sans-serif\" font-size=\"13\" fill=\"#222\">\n"
         "<rect width=\"100%\" height=\"100%\" fill=\"#fff\"/>\n" +
         text_at(width / 2.0, 26, title, "middle", " font-size=\"16\" font-weight=\"bold\"");
}

/// Frame, grid, numbers and labels of both axes.
std::string axes(const Plot& plot, const Scale& x, const Scale& y) {
  std::string out;
  for (const double v : ticks(y, 7)) {
    out += line_at(x.from, y.at(v), x.to, y.at(v), "#e3e3e3");
    out += text_at(x.from - 8, y.at(v) + 4.5, num(v), "end");
  }
  if (plot.categories.empty())
    for (const double v : ticks(x, 8)) {
      out += line_at(x.at(v), y.from, x.at(v), y.to, "#f0f0f0");
      out += text_at(x.at(v), y.from + 18, num(v), "middle");
    }
  else {
    std::size_t letters = 0;
    for (const std::string& c : plot.categories) letters = std::max(letters, c.size());
    const double room = (x.to - x.from) / static_cast<double>(plot.categories.size());
    const std::size_t every =
        static_cast<std::size_t>(std::ceil(static_cast<double>(letters) * 7.5 / room));
    for (std::size_t k = 0; k < plot.categories.size(); ++k)
      if (k % std::max<std::size_t>(1, every) == 0)
        out += text_at(x.at(static_cast<double>(k)), y.from + 18, plot.categories[k], "middle");
  }
  out += "<rect x=\"" + px(x.from) + "\" y=\"" + px(y.to) + "\" width=\"" + px(x.to - x.from) +
         "\" height=\"" + px(y.from - y.to) + "\" fill=\"none\" stroke=\"#555\"/>\n";
  out += text_at((x.from + x.to) / 2, y.from + 42, plot.x.label, "middle");
  const std::string middle = px((y.from + y.to) / 2);
  return out + text_at(20, (y.from + y.to) / 2, plot.y.label, "middle",
                       " transform=\"rotate(-90 20 " + middle + ")\"");
}

struct Frame {
  const Plot& plot;
  Scale x, y;
  std::size_t bar_series = 0;
};

std::string path_of(const Series& s, const Frame& frame, const std::string& colour) {
  std::string path;
  bool pen_down = false;
  double before = 0;
  for (std::size_t i = 0; i < s.x.size(); ++i) {
    if (!frame.x.shows(s.x[i]) || !frame.y.shows(s.y[i])) {
      pen_down = false;
      continue;
    }
    const double px_x = frame.x.at(s.x[i]), px_y = frame.y.at(s.y[i]);
    if (pen_down && s.kind == Series::Kind::steps) path += "L" + px(px_x) + " " + px(before);
    path += (pen_down ? "L" : "M") + px(px_x) + " " + px(px_y);
    pen_down = true;
    before = px_y;
  }
  return "<path d=\"" + path + "\" fill=\"none\" stroke=\"" + colour +
         "\" stroke-width=\"2\" stroke-linejoin=\"round\"" +
         (s.dashed ? " stroke-dasharray=\"7 4\"" : "") + "/>\n";
}

/// Points and bars, with their error bars.
std::string shapes_of(const Series& s, const Frame& frame, const std::string& colour,
                      std::size_t bar) {
  std::string out;
  const double bars = static_cast<double>(std::max<std::size_t>(1, frame.bar_series));
  const double slot = frame.plot.categories.empty()
                          ? 14
                          : 0.8 * (frame.x.to - frame.x.from) /
                                static_cast<double>(frame.plot.categories.size()) / bars;
  for (std::size_t i = 0; i < s.x.size(); ++i) {
    if (!frame.x.shows(s.x[i]) || !frame.y.shows(s.y[i])) continue;
    double at = frame.x.at(s.x[i]);
    const double top = frame.y.at(s.y[i]);
    if (s.kind == Series::Kind::bars) {
      at += slot * (static_cast<double>(bar) - (bars - 1) / 2);
      const double floor = frame.y.at(frame.y.log ? frame.y.least : std::max(0.0, frame.y.least));
      out += "<rect x=\"" + px(at - slot * 0.46) + "\" y=\"" + px(std::min(top, floor)) +
             "\" width=\"" + px(slot * 0.92) + "\" height=\"" + px(std::abs(floor - top)) +
             "\" fill=\"" + colour + "\"/>\n";
    } else {
      out += "<circle cx=\"" + px(at) + "\" cy=\"" + px(top) + "\" r=\"3.2\" fill=\"" + colour +
             "\" fill-opacity=\"0.75\"/>\n";
    }
    if (i < s.least.size() && i < s.most.size() && frame.y.shows(s.least[i]) &&
        frame.y.shows(s.most[i]))
      out += line_at(at, frame.y.at(s.least[i]), at, frame.y.at(s.most[i]), "#222");
  }
  return out;
}

std::string legend(const Frame& frame, bool names_needed) {
  if (!names_needed) return "";
  std::string out;
  const double x = frame.x.to + 16;
  double y = frame.y.to + 10;
  for (std::size_t k = 0; k < frame.plot.series.size(); ++k) {
    const Series& s = frame.plot.series[k];
    const std::string colour = kColours[k % std::size(kColours)];
    if (s.kind == Series::Kind::line || s.kind == Series::Kind::steps)
      out += "<line x1=\"" + px(x) + "\" y1=\"" + px(y) + "\" x2=\"" + px(x + 22) + "\" y2=\"" +
             px(y) + "\" stroke=\"" + colour + "\" stroke-width=\"2.5\"" +
             (s.dashed ? " stroke-dasharray=\"6 3\"" : "") + "/>\n";
    else
      out += "<rect x=\"" + px(x + 5) + "\" y=\"" + px(y - 6) + "\" width=\"12\" height=\"12\"" +
             " fill=\"" + colour + "\"/>\n";
    out += text_at(x + 28, y + 4.5, s.name, "start");
    y += 21;
  }
  return out;
}

double legend_width(const Plot& plot) {
  std::size_t letters = 0;
  for (const Series& s : plot.series) letters = std::max(letters, s.name.size());
  return plot.series.size() > 1 || (plot.series.size() == 1 && !plot.series[0].name.empty())
             ? 56 + 7.3 * static_cast<double>(letters)
             : 0;
}

// Dark blue, green, yellow: rises in lightness, so that it also reads in grey (after viridis).
std::string heat(double t) {
  static constexpr std::array<std::array<double, 3>, 5> kStops{
      {{68, 1, 84}, {59, 82, 139}, {33, 145, 140}, {94, 201, 98}, {253, 231, 37}}};
  const double at = std::clamp(t, 0.0, 1.0) * 4;
  const auto low = std::min<std::size_t>(3, static_cast<std::size_t>(at));
  const double part = at - static_cast<double>(low);
  char text[16];
  int rgb[3];
  for (std::size_t c = 0; c < 3; ++c)
    rgb[c] = static_cast<int>(
        std::lround(kStops[low][c] + part * (kStops[low + 1][c] - kStops[low][c])));
  std::snprintf(text, sizeof text, "#%02x%02x%02x", static_cast<unsigned>(rgb[0]),
                static_cast<unsigned>(rgb[1]), static_cast<unsigned>(rgb[2]));
  return text;
}

}  // namespace

std::string to_svg(const Plot& plot) {
  std::vector<double> xs, ys = plot.levels;
  Frame frame{plot, {}, {}, 0};
  for (const Series& s : plot.series) {
    xs.insert(xs.end(), s.x.begin(), s.x.end());
    ys.insert(ys.end(), s.y.begin(), s.y.end());
    ys.insert(ys.end(), s.least.begin(), s.least.end());
    ys.insert(ys.end(), s.most.begin(), s.most.end());
    if (s.kind == Series::Kind::bars) ++frame.bar_series;
  }
  frame.x = scale_for(plot.x, xs, false);
  if (!plot.categories.empty()) {
    frame.x.least = -0.5;
    frame.x.most = static_cast<double>(plot.categories.size()) - 0.5;
  }
  frame.y = scale_for(plot.y, ys, frame.bar_series > 0);
  const double names = legend_width(plot);
  frame.x.from = kLeft, frame.x.to = plot.width - kRight - names;
  frame.y.from = plot.height - kBottom, frame.y.to = kTop;

  std::string out = head(plot.width, plot.height, plot.title) + axes(plot, frame.x, frame.y);
  for (const double level : plot.levels)
    out += "<line x1=\"" + px(frame.x.from) + "\" y1=\"" + px(frame.y.at(level)) + "\" x2=\"" +
           px(frame.x.to) + "\" y2=\"" + px(frame.y.at(level)) +
           "\" stroke=\"#b00020\" stroke-dasharray=\"4 3\"/>\n";
  std::size_t bar = 0;
  for (std::size_t k = 0; k < plot.series.size(); ++k) {
    const Series& s = plot.series[k];
    const std::string colour = kColours[k % std::size(kColours)];
    const bool drawn = s.kind == Series::Kind::line || s.kind == Series::Kind::steps;
    out += drawn ? path_of(s, frame, colour) : shapes_of(s, frame, colour, bar);
    if (s.kind == Series::Kind::bars) ++bar;
  }
  return out + legend(frame, names > 0) + "</svg>\n";
}

std::string to_svg(const Landscape& landscape) {
  Plot plot;
  plot.title = landscape.title, plot.x = landscape.x, plot.y = landscape.y;
  const Scale value = scale_for({}, landscape.values, false);
  double low = 1e300, high = -1e300;
  for (const double v : landscape.values)
    if (std::isfinite(v)) low = std::min(low, v), high = std::max(high, v);
  if (!(high > low)) low = value.least, high = value.most;
  Scale x{landscape.x.least.value_or(0), landscape.x.most.value_or(1), kLeft, plot.width - 130.0};
  Scale y{landscape.y.least.value_or(0), landscape.y.most.value_or(1), plot.height - kBottom, kTop};

  std::string out = head(plot.width, plot.height, plot.title);
  const double w = (x.to - x.from) / static_cast<double>(landscape.columns),
               h = (y.from - y.to) / static_cast<double>(landscape.rows);
  for (std::size_t r = 0; r < landscape.rows; ++r)
    for (std::size_t c = 0; c < landscape.columns; ++c) {
      const double v = landscape.values[r * landscape.columns + c];
      if (!std::isfinite(v)) continue;
      out += "<rect x=\"" + px(x.from + w * static_cast<double>(c)) + "\" y=\"" +
             px(y.from - h * static_cast<double>(r + 1)) + "\" width=\"" + px(w + 0.4) +
             "\" height=\"" + px(h + 0.4) + "\" fill=\"" + heat((v - low) / (high - low)) +
             "\"/>\n";
    }
  out += axes(plot, x, y);
  for (const Landscape::Mark& mark : landscape.marks) {
    out += "<circle cx=\"" + px(x.at(mark.x)) + "\" cy=\"" + px(y.at(mark.y)) +
           "\" r=\"6\" fill=\"none\" stroke=\"#fff\" stroke-width=\"3\"/><circle cx=\"" +
           px(x.at(mark.x)) + "\" cy=\"" + px(y.at(mark.y)) +
           "\" r=\"6\" fill=\"none\" stroke=\"#d00\" stroke-width=\"1.5\"/>\n";
    out += text_at(x.at(mark.x) + 10, y.at(mark.y) + 4.5, mark.name, "start",
                   " stroke=\"#fff\" stroke-width=\"3\" paint-order=\"stroke\"");
  }
  const double side = x.to + 26;
  for (int k = 0; k < 60; ++k)
    out += "<rect x=\"" + px(side) + "\" y=\"" + px(y.from - (y.from - y.to) * (k + 1) / 60) +
           "\" width=\"18\" height=\"" + px((y.from - y.to) / 60 + 0.4) + "\" fill=\"" +
           heat((k + 0.5) / 60) + "\"/>\n";
  const Scale bar{low, high, y.from, y.to};
  for (const double v : ticks(bar, 6)) out += text_at(side + 24, bar.at(v) + 4.5, num(v), "start");
  return out + text_at(side, y.to - 8, landscape.value_label, "start") + "</svg>\n";
}

}  // namespace chiaro::core
