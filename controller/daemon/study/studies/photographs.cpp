// SPDX-License-Identifier: Apache-2.0
// Real portraits as exemplars: nobody knows the truth about their light, so a person judges. Each
// picture stands beside the preview, what the virtual studio's camera then sees, and what was found
// and said, on one page.
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <ostream>

#include "controller/core/picture_file.h"
#include "controller/daemon/study/strangers.h"
#include "controller/daemon/study/study.h"
#include "controller/design/align.h"
#include "controller/design/words.h"

namespace chiaro::daemon::study {
namespace {

namespace fs = std::filesystem;

constexpr int kShown = 256;  // pixels of a picture on the page

struct Judged {
  std::string name;
  core::Picture reference, preview, camera;
  std::string key, ratio, laid_by, verdict, remedy;
  std::vector<std::string> words;
  double residual = 0;
};

std::vector<fs::path> pictures_in(const fs::path& folder) {
  std::vector<fs::path> files;
  std::error_code error;
  for (const auto& entry : fs::directory_iterator(folder, error))
    if (entry.is_regular_file(error)) files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  return files;
}

/// The shipped moods' pictures, as if nobody knew them: what to show where there is no photograph.
std::vector<fs::path> drawn_ones(const fs::path& config) {
  std::vector<fs::path> files;
  for (const char* mood : {"rembrandt", "butterfly", "split"})
    files.push_back(config / "moods" / mood / "picture.png");
  return files;
}

std::string name_of(const fs::path& file) {
  return file.stem() == "picture" ? file.parent_path().filename().string() : file.stem().string();
}

std::string place_of_key(const studio::Rig& rig, std::size_t key) {
  const core::FixtureState& state = rig.states[key];
  return core::azimuth_in_words(state.get(core::Dof::azimuth)) + ", " +
         core::elevation_in_words(state.get(core::Dof::elevation));
}

std::string laid_by(const design::ExampleGoal& goal) {
  using By = design::Alignment::By;
  const By by = design::aligned(goal, design::OurFace{}).by;
  return by == By::face ? "its face" : by == By::outline ? "its outline" : "its frame alone";
}

core::Picture square(const core::Picture& picture) {
  return design::seen_through(picture, design::Window{}, {kShown, kShown});
}

core::Result<Judged> judged(const fs::path& file, const studio::Studio& studio,
                            const design::LayersSource& twin, const Reality& real,
                            const Options& options, ports::World& world) {
  const auto picture = core::read_picture(file);
  if (!picture) return picture.problems();
  design::ExampleGoal goal;
  goal.name = name_of(file);
  goal.exemplar = core::linear_at_most(*picture);
  design::Options usual = plain_options(options.seed, options.threads, world);
  usual.align = usual.normalise = true;
  if (options.quick) usual.trials = 120;
  const auto look = design::design(studio, twin, goal, usual);
  if (!look) return look.problems();
  Judged out;
  out.name = goal.name;
  out.reference = square(goal.exemplar);
  out.preview = look->picture;
  out.camera =
      photograph(studio, real, look->wanted,
                 {{kShown, kShown}, options.quick ? 4 : 12, options.seed, options.threads});
  out.key = place_of_key(look->wanted, *studio.fixture_index("key"));
  out.ratio = design::ratio_in_words(studio, look->wanted);
  if (out.ratio.empty()) out.ratio = "one lamp alone";
  out.laid_by = laid_by(goal);
  out.verdict = design::name_of(look->judgement.verdict);
  out.remedy = look->judgement.remedy;
  out.words = look->warnings;
  out.residual = look->judgement.residual;
  return out;
}

// ---- the page -----------------------------------------------------------------------------------

std::string escaped(const std::string& text) {
  std::string out;
  for (const char c : text)
    out += c == '&' ? "&amp;" : c == '<' ? "&lt;" : c == '"' ? "&quot;" : std::string(1, c);
  return out;
}

std::string base64(const std::vector<std::uint8_t>& bytes) {
  static constexpr char kDigits[] =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string out;
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    const auto at = [&](std::size_t k) {
      return i + k < bytes.size() ? std::uint32_t{bytes[i + k]} : 0;
    };
    const std::uint32_t three = at(0) << 16u | at(1) << 8u | at(2);
    for (std::size_t k = 0; k < 4; ++k)
      out += i + k <= bytes.size() ? kDigits[three >> (18 - 6 * k) & 63u] : '=';
  }
  return out;
}

std::string image(const core::Picture& picture, const std::string& what) {
  return "<td><img alt=\"" + escaped(what) + "\" width=\"" + std::to_string(kShown) +
         "\" src=\"data:image/jpeg;base64," +
         base64(core::encode_jpeg(core::encoded(picture), 88)) + "\"></td>";
}

std::string page_of(const std::vector<Judged>& all) {
  std::string page =
      "<!DOCTYPE html><html lang=\"en-GB\"><meta charset=\"utf-8\"><title>Photographs as "
      "references</title><style>body{font:15px sans-serif;background:#222;color:#ddd;margin:2em}"
      "td{vertical-align:top;padding:6px}td.words{width:26em}b{color:#fff}</style>"
      "<h1>Photographs as references</h1><p>Each reference, the preview, what the virtual studio's "
      "camera sees with the lamps so, and what was found.</p><table><tr><th>reference<th>preview"
      "<th>camera<th>found</tr>\n";
  for (const Judged& one : all) {
    page += "<tr>" + image(one.reference, one.name) + image(one.preview, "preview") +
            image(one.camera, "camera") + "<td class=\"words\"><b>" + escaped(one.name) +
            "</b>: <b>" + one.verdict + "</b> (residual " + design::number(one.residual, 2) +
            ")<br>key " + escaped(one.key) + "<br>" + escaped(one.ratio) +
            "<br>laid on the sitter by " + escaped(one.laid_by);
    if (!one.remedy.empty()) page += "<br>remedy: " + escaped(one.remedy);
    for (const std::string& word : one.words) page += "<br>&bull; " + escaped(word);
    page += "</td></tr>\n";
  }
  return page + "</table></html>\n";
}

Table table_of(const std::vector<Judged>& all) {
  Table table{"photographs",
              "Photographs as references",
              {"picture", "key", "key to fill", "laid on by", "verdict", "residual", "remedy"}};
  for (const Judged& one : all)
    table.rows.push_back(
        {one.name, one.key, one.ratio, one.laid_by, one.verdict, one.residual, one.remedy});
  return table;
}

}  // namespace

core::Result<Findings> run_photographs(const Options& options, ports::World& world) {
  Findings findings;
  const fs::path folder = fs::path(options.assets) / "photographs";
  std::vector<fs::path> files;
  if (!options.assets.empty()) files = pictures_in(folder);
  const bool real_ones = !files.empty();
  if (!real_ones) files = drawn_ones(world.config_folder);
  if (options.quick && files.size() > 6) files.resize(6);
  if (options.items > 0 && files.size() > static_cast<std::size_t>(options.items))
    files.resize(static_cast<std::size_t>(options.items));
  auto studio = portrait_studio(world);
  if (!studio) return studio.problems();
  auto twin = twin_of(*studio, world, options.threads);
  if (!twin) return twin.problems();
  core::Random random(options.seed);
  const Reality real = reality(*studio, kNoErrors, random, world);
  std::vector<Judged> all;
  for (const fs::path& file : files) {
    if (world.stop) break;
    world.err << "  " << file.filename().string() << "\n" << std::flush;
    auto one = judged(file, *studio, **twin, real, options, world);
    if (one)
      all.push_back(*std::move(one));
    else
      findings.notes.push_back(core::to_string(one.problems()));
  }
  findings.items = static_cast<int>(all.size());
  findings.tables.push_back(table_of(all));
  findings.pages.push_back({"photographs.html", page_of(all)});
  if (!real_ones)
    findings.notes.push_back(
        "No photographs were found, so drawn moods stand in: give --assets the folder of "
        "tests/support/fetch_assets.sh, or one of your own with pictures in its folder "
        "photographs.");
  findings.notes.push_back(
      "photographs.html shows each beside its preview. Where its light really came from nobody "
      "wrote down: look and judge. Pictures are read from packages and stay out of this project.");
  return findings;
}

}  // namespace chiaro::daemon::study
