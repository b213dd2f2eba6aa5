// SPDX-License-Identifier: Apache-2.0
// What a person reads when the file is wrong: every problem at once, where, what, and the remedy.
#include <algorithm>
#include <fstream>
#include <gtest/gtest.h>

#include "controller/studio/load.h"
#include "tests/support/fake_world.h"
#include "tests/support/studio_text.h"

namespace chiaro::studio {
namespace {

core::Problems problems_of(const std::string& text) {
  support::TemporaryFolder folder;
  support::write_full_studio_files(folder.path());
  const auto loaded = parse_studio(text, folder.path(), support::shipped_folders());
  return loaded.problems();
}

TEST(Problems, AllOfThemAtOnceInTheOrderOfTheFile) {
  constexpr const char* kBroken = R"(studio: broken
subject:
  stand_in: person
  eye_hight: 1.2 m
  at: [0, 0, .nan]
background:
  - {plane: wall, through: [0, 2.0, 0], normal: [0, 0, 0], size: [6, 4]}
cameras:
  main: {at: [0, -2.6, 1.45], look_at: [0, 0, 1.35], vertical_fov: 22, size: [640, 480]}
fixtures:
  key:
    role: kay
    profile: generic/bicolor-panel
    mount: {stand: {at: {azimuth: -95 deg, elevation: 35 deg, distance: 1.8 m}, azimuth: [80 deg, -80 deg], elevation: [-45 deg, 20 deg]}}
    patch: {universe: 1, address: 1}
  fill:
    role: fill
    profile: generic/bicolour-panel
    mode: 4ch
    mount: {stand: {at: {azimuth: 40 deg, elevation: 10 K, distance: 2,0 m}}}
    patch: {universe: 1, address: 100}
  back: {role: back, profile: generic/dimmer, mode: 1ch, mount: {fixed: {at: [-0.8, 1.1, 2.3], aim_at: [0, 0, 1.4]}}, patch: {universe: 2, address: 512}}
  wall: {role: background, profile: generic/rgbw, mode: 4ch, mount: {fixed: {at: [1, 1, 1], aim_at: [0, 2, 1]}}, patch: {universe: 2, address: 510}}
outputs:
  universe 1: {sacn: {interface: lo, rate: 400 Hz}}
exposure: {grey_card: 800 lx, white_balance: 56000 K}
outputs:
  universe 3: mock
)";
  EXPECT_EQ(core::to_string(problems_of(kBroken)),
            R"(studio.yaml:3:3: a subject has no 'eye_height' (add eye_height: 1.55 m)
studio.yaml:4:3: a subject has no setting 'eye_hight' (did you mean 'eye_height'?)
studio.yaml:5:14: 'at' is '.nan', expected a number, -1000 to 1000 (write a plain number here)
studio.yaml:7:49: 'normal' is [0, 0, 0], which points nowhere (for example [0, 0, 1] for straight up)
studio.yaml:9:68: 'vertical_fov' is '22', expected an angle such as 26 deg (write the unit too: 22 deg)
studio.yaml:12:11: 'role' is 'kay', expected key, fill, back, hair, kicker, background or practical (did you mean 'key'?)
studio.yaml:13:14: there is no fixture profile 'generic/bicolor-panel' (did you mean 'generic/bicolour-panel'?)
studio.yaml:14:25: the lamp stands outside its own region: elevation 35 deg is not within -45 deg to 20 deg (move 'at', or widen 'elevation')
studio.yaml:14:90: the range of 'azimuth' runs backwards (write the smaller value first)
studio.yaml:19:11: generic/bicolour-panel has no mode '4ch' (did you mean '2ch'?)
studio.yaml:20:54: 'elevation' is '10 K', expected an angle such as 26 deg ('K' is the unit of something else)
studio.yaml:20:70: 'distance' is '2', expected a length such as 0.6 m (write the unit too: 2 m)
studio.yaml:20:72: a place about the subject has no setting '0 m' (known here: azimuth, elevation or distance)
studio.yaml:22:126: 'back' is patched to universe 2, which has no output (add outputs: {universe 2: {sacn: {interface: eth0}}})
studio.yaml:23:121: 'wall' needs 4 slots and would run to 513, a universe has 512 (address 1 is free)
studio.yaml:23:121: 'wall' (510 to 513) overlaps 'back' (512) on universe 2 (address 1 is free)
studio.yaml:25:44: 'rate' is '400 Hz', expected 1 Hz to 44 Hz (correct the value)
studio.yaml:26:46: 'white_balance' is '56000 K', expected 1500 K to 20000 K (correct the value)
studio.yaml:27:1: 'outputs' stands here twice (first in line 24) (give one of them another name, or delete it)
)");
}

/// One change to the file that has everything, the text at which the problem is placed, and what
/// is said about it.
struct Case {
  const char *name, *from, *to, *at, *expected;
};
void PrintTo(const Case& c, std::ostream* out) { *out << c.name; }

/// "line:column" of the first `at` behind the edit's beginning, counted here, not by the reader.
std::string place_of(const std::string& text, const Case& c) {
  const std::size_t edit = text.find(c.to);
  std::size_t found = text.find(c.at, *c.to == '\0' ? 0 : edit);
  if (found == std::string::npos) found = text.rfind(c.at, edit);
  const auto begin = text.begin(), end = begin + static_cast<std::ptrdiff_t>(found);
  const std::size_t line_start = found == 0 ? 0 : text.rfind('\n', found - 1) + 1;
  return std::to_string(1 + std::count(begin, end, '\n')) + ":" +
         std::to_string(found - line_start + 1);
}

class OneProblem : public ::testing::TestWithParam<Case> {};

TEST_P(OneProblem, IsFoundAloneAtItsPlaceWithItsRemedy) {
  const Case& c = GetParam();
  const std::string text = support::edited(support::full_studio_text(), c.from, c.to);
  std::string errors;
  for (const core::Problem& problem : problems_of(text))
    if (!problem.warning) errors += core::to_string(problem) + "\n";
  EXPECT_EQ(errors, "studio.yaml:" + place_of(text, c) + ": " + c.expected + "\n");
}

INSTANTIATE_TEST_SUITE_P(
    Studio, OneProblem,
    ::testing::Values(
        Case{"UnknownKey", "ceiling:", "cieling:", "cieling",
             "a studio has no setting 'cieling' (did you mean 'ceiling'?)"},
        Case{"NoName", "studio: everything once\n", "", "subjects",
             "a studio has no 'studio' (add studio: a name for it)"},
        Case{"MissingMesh", "mesh.ply", "/nowhere/mesh.ply", "/nowhere",
             "there is no mesh '/nowhere/mesh.ply' (check the path)"},
        Case{"MissingPicture", "frame.png", "/nowhere.png", "/nowhere",
             "there is no picture '/nowhere.png' (check the path)"},
        Case{"MeshForAStandIn", "eye_height: 1.55 m", "eye_height: 1.55 m\n    height: 2 m", "2 m",
             "'height' does not go with a stand-in (the shipped bust is used, placed by its "
             "eye_height)"},
        Case{"HugeNumber", "[-0.4, 0.1, 0]", "[-0.4, 1e300, 0]", "1e300",
             "'at' is '1e300', expected a number, -1000 to 1000 (correct the value)"},
        Case{"Infinity", "iso: 400", "iso: .inf", ".inf",
             "'iso' is '.inf', expected a number, 1 to 1e+07 (write a plain number here)"},
        Case{"ShutterAlone", "    aperture: f/2.8\n    iso: 400\n", "", "at: [2, -2, 1.5]",
             "shutter, aperture and iso belong together (give all three, or none and use exposure: "
             "{grey_card: 800 lx})"},
        Case{"CameraLooksAtItself", "look_at: [0, 0, 1.4]", "look_at: [2, -2, 1.5]", "side:",
             "the camera looks at the point where it stands (move 'look_at' to the subject)"},
        Case{"NotAnHttpAddress", "http://10.0.0.2/a", "ftp://10.0.0.2/a", "\"ftp",
             "'ftp://10.0.0.2/a' is not an http:// address (for example "
             "http://192.168.0.20/picture)"},
        Case{"UnknownMount", "{track: {", "{trakc: {", "trakc",
             "'trakc' is not a kind of mount (did you mean 'track'?)"},
        Case{"UnknownBus", "{modbus: rail, register: 40}", "{modbus: rial, register: 40}", "rial",
             "there is no bus 'rial' (did you mean 'rail'?)"},
        Case{"TwoPatchesInOne", "{modbus: rail, register: 40}",
             "{modbus: rail, register: 40, universe: 1}", "universe",
             "a patch has no setting 'universe' (known here: modbus or register)"},
        Case{"AddressBeyondTheUniverse", "address: 511", "address: 513", "513",
             "'address' is '513', expected a whole number, 1 to 512 (correct the value)"},
        Case{"OverlapOnABus", "{modbus: rail, register: 40}\n    curve: square",
             "{modbus: rail, register: 40}\n    curve: square\n  twin: {role: background, profile: "
             "generic/rgb, mode: 3ch, mount: {fixed: {at: [1, 1, 1], aim_at: [0, 2, 1]}}, patch: "
             "{modbus: rail, register: 47}}",
             "{modbus: rail, register: 47",
             "'twin' (47 to 49) overlaps 'drive' (40 to 47) on bus 'rail' (use other registers)"},
        Case{"GelOnIntensity", "{intensity: flash_power}", "{intensity: gel}", "gel",
             "'gel' does not set 'intensity' (knob sets light, colour or zoom, gel cct or tint, "
             "flash_power intensity)"},
        Case{"NothingSetsTheLight", "    by_hand: {intensity: flash_power}\n", "", "flash:",
             "nothing can set the light of 'flash' (add patch: {universe: 1, address: 1}, or "
             "by_hand: {intensity: knob}, or controlled: no for a lamp that stays as it is)"},
        Case{"SafeAboveMost", "safe_level: 0.1", "safe_level: 0.9", "0.9",
             "the safe level lies above the most this lamp may give (lower safe_level or raise "
             "most)"},
        Case{"StartsAboveItsLimit", "{intensity: 30 %, cct: 4300 K}", "{intensity: 90 %}", "90 %",
             "'intensity' lies above the most this lamp may give (lower it or raise limits: most)"},
        Case{"ColourTheLampCannotGive", "cct: 4300 K", "cct: 9000 K", "9000",
             "'cct' is '9000 K', expected 2700 K to 6500 K (correct the value)"},
        Case{"TableThatFalls", "[0, 0.1, 0.5, 1]", "[0, 0.6, 0.5, 1]", "0.5, 1]",
             "the table falls here (more drive must not give less light)"},
        Case{"UniverseTwice", "universe 3: {mock", "universe 02: {mock", "universe 02",
             "universe 2 has two outputs (keep one of them)"},
        Case{"NotAUniverse", "universe 3: {mock", "universe three: {mock", "universe three",
             "'universe three' is no output, expected 'universe' and its number, 1 to 63999 (for "
             "example universe 1: {sacn: {interface: eth0}})"},
        Case{"BadUnicast", "10.0.0.7", "10.0.0.700", "10.0.0.700",
             "'10.0.0.700' is no IPv4 address (for example 192.168.0.20)"},
        Case{"AboveTheCeiling", "[-0.8, 1.1, 2.3]", "[-0.8, 1.1, 3.3]", "tungsten:\n",
             "'tungsten' is at a height of 3.3 m, above the ceiling (3.048 m) (lower it, or "
             "correct 'ceiling')"},
        Case{
            "ANameThatCannotBeOne", "  free:", "  \"fr/ee\":", "\"fr/ee\"",
            "'fr/ee' cannot be a name (use letters, digits, '-', '_', '.' and spaces, at most 40)"},
        Case{"AmbientLevelBesideAFrame", "{illuminance: 20 lx, cct: 4000 K}",
             "{illuminance: 20 lx, measured: off.exr}", "{illuminance",
             "ambient light needs either its illuminance or a measured frame (ambient: "
             "{illuminance: 20 lx, cct: 4000 K}, or {measured: lamps-off.exr})"},
        Case{"CameraWithoutAnAngle", "vertical_fov: 0.5 rad\n    ", "", "at: [2, -2, 1.5]",
             "a camera has no 'vertical_fov' (add vertical_fov: 22 deg)"}),
    [](const ::testing::TestParamInfo<Case>& each) { return each.param.name; });

TEST(Problems, ABrokenProfileIsReportedOnceWithItsOwnPlaces) {
  namespace fs = std::filesystem;
  support::TemporaryFolder config, folder;
  fs::copy(support::shipped_folders().config, config.path(), fs::copy_options::recursive);
  support::write_full_studio_files(folder.path());
  const fs::path profile = config.path() / "fixtures/generic/rgbw.yaml";
  std::ofstream(profile) << "profile: generic/rgbw\nmaker: Generic\nmodel: X\noutput: 15000\n"
                            "optic: point\nemitter: {dimmer: {cct: 3200 K}}\n"
                            "modes: {4ch: [{controls: intensity}], 8ch-16bit: [{controls: cct}]}\n";
  const auto loaded =
      parse_studio(support::full_studio_text(), folder.path(), Folders{config.path()});
  ASSERT_FALSE(loaded.ok());
  std::string errors;
  for (const core::Problem& problem : loaded.problems())
    if (!problem.warning) errors += core::to_string(problem) + "\n";
  EXPECT_EQ(errors,
            "studio.yaml:79:14: the fixture profile 'generic/rgbw' has problems of its own (see " +
                profile.string() +
                ")\nstudio.yaml:92:14: the fixture profile 'generic/rgbw' has problems of its own "
                "(see " +
                profile.string() + ")\n" + profile.string() +
                ":4:9: 'output' is '15000', expected a luminous intensity such as 12000 cd (write "
                "the unit too: 15000 cd)\n" +
                profile.string() +
                ":7:51: what the raw values of 'cct' mean is not known (add ranges: [{dmx: [0, "
                "255], means: [from, to]}], or give the lamp that setting)\n");
}

}  // namespace
}  // namespace chiaro::studio
