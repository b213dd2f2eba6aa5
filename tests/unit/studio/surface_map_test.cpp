// SPDX-License-Identifier: Apache-2.0
#include "controller/studio/surface_map.h"

#include <fstream>
#include <gtest/gtest.h>
#include <set>

#include "tests/support/fake_world.h"
#include "tests/support/studio_text.h"

namespace chiaro::studio {
namespace {

const std::filesystem::path kShipped = CHIARO_SOURCE "/config/surfaces";

core::Result<SurfaceMap> parse(const std::string& rest) {
  return parse_surface_map("surface: a/b\nmaker: A\ndevice: B\n" + rest, "a/b", "b.yaml");
}
/// The first problem as people read it.
std::string problem(const std::string& rest) {
  const auto map = parse(rest);
  return map ? "" : core::to_string(map.problems()[0]);
}

TEST(SurfaceMaps, ThatAreShippedAllLoadAndServeEveryDriver) {
  std::set<std::string> drivers;
  for (const auto& name : surface_map_names(kShipped)) {
    const auto map = load_surface_map(name, {}, kShipped);
    ASSERT_TRUE(map) << core::to_string(map.problems());
    EXPECT_FALSE(map->controls.empty()) << name;
    drivers.insert(map->driver);
  }
  EXPECT_EQ(drivers, (std::set<std::string>{"gpio", "hid", "midi", "osc"}));
}

TEST(SurfaceMaps, SayWhereEachControlIsAndWhatItDoes) {
  const auto map = parse(
      "driver: midi\nname: Desk\ncontrols:\n"
      "  grand: {controller: 7, channel: 3, do: {master: grand}}\n"
      "  wheel: {controller: 16, kind: encoder, do: {level: hair, step: 1 %}}\n"
      "  stop: {note: 42, do: [blackout on, motion stop]}\n"
      "  warm: {note: 43, do: {warmer: -0.25 stops}, shows: tally}\n"
      "  bump: {note: 44, do: {flash: hair}}\n"
      "  white: {controller: 17, do: {level: hair, of: cct}}\n"
      "  second: {note: 45, do: {cue: 2.5}}\n");
  ASSERT_TRUE(map) << core::to_string(map.problems());
  const SurfaceControl& grand = *map->control("grand");
  EXPECT_EQ(grand.kind, SurfaceControl::Kind::fader);
  EXPECT_EQ(grand.midi, SurfaceControl::Midi::controller);
  EXPECT_EQ(grand.channel, 2);
  EXPECT_EQ(grand.number, 7);
  EXPECT_EQ(in_words(grand.deeds.at(0)), "master grand");
  EXPECT_EQ(in_words(grand.shown), "master grand");  // a motor fader follows without being told
  const SurfaceControl& wheel = *map->control("wheel");
  EXPECT_EQ(wheel.kind, SurfaceControl::Kind::encoder);
  EXPECT_DOUBLE_EQ(wheel.deeds.at(0).step, 0.01);
  const SurfaceControl& stop = *map->control("stop");
  ASSERT_EQ(stop.deeds.size(), 2u);
  EXPECT_EQ(stop.deeds[0].kind, Deed::Kind::blackout);
  EXPECT_EQ(stop.deeds[0].press, Deed::Press::on);
  EXPECT_EQ(stop.deeds[1].kind, Deed::Kind::motion_stop);
  EXPECT_EQ(stop.shown.kind, Shown::Kind::blackout);
  EXPECT_EQ(map->control("bump")->deeds.at(0).press, Deed::Press::follow);
  EXPECT_EQ(in_words(map->control("bump")->deeds.at(0)), "flash hair");
  EXPECT_EQ(in_words(map->control("white")->deeds.at(0)), "cct of hair");
  EXPECT_EQ(in_words(map->control("second")->shown), "cue 2.5");
  EXPECT_EQ(in_words(map->control("warm")->deeds.at(0)), "warmer by -0.25 stops");
  EXPECT_EQ(map->control("warm")->shown.kind, Shown::Kind::lit);
}

TEST(SurfaceMaps, ReadHidAndGpioPlaces) {
  const auto hid = parse(
      "driver: hid\nusb: \"1209:2882\"\nreport: {size: 3, number: 1}\ncontrols:\n"
      "  stop: {byte: 2, bit: 5, lamp: {byte: 2, bit: 1}, do: blackout}\n"
      "  slide: {byte: 4, bytes: 2, most: 1023, do: {master: key}}\n");
  ASSERT_TRUE(hid) << core::to_string(hid.problems());
  EXPECT_EQ(hid->product, 0x2882);
  EXPECT_EQ(hid->report_number, 1);
  EXPECT_EQ(hid->control("stop")->bit, 5);
  EXPECT_EQ(hid->control("stop")->lamp_byte, 2);
  EXPECT_EQ(hid->control("slide")->kind, SurfaceControl::Kind::fader);
  EXPECT_EQ(hid->control("slide")->most, 1023);
  const auto gpio = parse(
      "driver: gpio\ncontrols:\n  stop: {line: 17, debounce: 5 ms, pull_up: yes, do: blackout on}\n"
      "  horn: {line: 4, active_low: yes, shows: trouble}\n");
  ASSERT_TRUE(gpio) << core::to_string(gpio.problems());
  EXPECT_FALSE(gpio->control("stop")->output);
  EXPECT_DOUBLE_EQ(gpio->control("stop")->debounce_s, 0.005);
  EXPECT_TRUE(gpio->control("horn")->output);
  EXPECT_TRUE(gpio->control("horn")->active_low);
}

TEST(SurfaceMaps, SayWhatIsWrongAndWhere) {
  const std::string midi = "driver: midi\nname: D\ncontrols:\n  a: ";
  EXPECT_NE(problem(midi + "{note: 1, do: blakout}").find("b.yaml:7:20"), std::string::npos)
      << problem(midi + "{note: 1, do: blakout}");
  EXPECT_NE(problem(midi + "{note: 1, do: blakout}").find("blackout"), std::string::npos);
  EXPECT_NE(problem(midi + "{note: 1, do: {master: gand}}").find("grand"), std::string::npos);
  EXPECT_NE(problem(midi + "{note: 1, do: {master: grand}}").find("a button cannot"),
            std::string::npos);
  EXPECT_NE(problem(midi + "{controller: 1, do: blackout}").find("a fader cannot"),
            std::string::npos);
  EXPECT_NE(problem(midi + "{controller: 1, kind: encoder, do: cue go}").find("an encoder cannot"),
            std::string::npos);
  EXPECT_NE(problem(midi + "{note: 1}").find("neither does nor shows"), std::string::npos);
  EXPECT_NE(problem(midi + "{do: blackout}").find("one kind of message"), std::string::npos);
  EXPECT_NE(problem(midi + "{note: 1, do: {warmer: 0.25}}").find("stops"), std::string::npos);
  EXPECT_NE(problem(midi + "{note: 1, do: blackout}\n  b: {note: 1, do: cue go}")
                .find("'b' is the same control as 'a'"),
            std::string::npos);
  EXPECT_NE(problem("driver: osc\ncontrols:\n  a: {osc: stop, do: blackout}").find("OSC address"),
            std::string::npos);
  EXPECT_NE(problem("driver: hid\nusb: 12\ncontrols: {a: {byte: 1, bit: 1, do: blackout}}")
                .find("USB ids"),
            std::string::npos);
  EXPECT_NE(problem("driver: hid\nusb: \"1209:2882\"\ncontrols: {a: {lamp: {byte: 2}, shows: on}}")
                .find("no byte 2"),
            std::string::npos);
}

TEST(SurfaceMaps, ReportEveryMistakeAtOnce) {
  const auto map =
      parse("driver: midi\nname: D\ncontrols:\n  a: {note: 200, do: x}\n  b: {nte: 1}\n");
  ASSERT_FALSE(map);
  EXPECT_GE(map.problems().size(), 4u);
}

class SurfacesOfAStudio : public testing::Test {
 protected:
  SurfacesOfAStudio() { support::write_full_studio_files(folder_.path()); }
  core::Result<Loaded> parse(const std::string& yaml) {
    return parse_studio(yaml, folder_.path(), support::shipped_folders());
  }
  std::string problem(const std::string& from, const std::string& to) {
    const auto loaded = parse(support::edited(support::full_studio_text(), from, to));
    return loaded ? "" : core::to_string(loaded.problems());
  }
  support::TemporaryFolder folder_;
};

TEST_F(SurfacesOfAStudio, AreReadWithTheirMapsAndTheStudiosOwnUses) {
  const auto loaded = parse(support::full_studio_text());
  ASSERT_TRUE(loaded) << core::to_string(loaded.problems());
  const auto& surfaces = loaded->studio.surfaces;
  ASSERT_EQ(surfaces.size(), 5u);
  EXPECT_EQ(surfaces[0].driver, "midi");
  EXPECT_EQ(surfaces[0].midi_name, "nanoKONTROL2 MIDI 1");
  EXPECT_EQ(in_words(surfaces[0].map.control("fader 6")->deeds.at(0)), "level of hair");
  EXPECT_EQ(surfaces[0].map.control("stop")->deeds.size(), 2u);
  EXPECT_EQ(surfaces[1].device.vendor, 0x0fd9);
  EXPECT_EQ(surfaces[1].device.serial, "A1");
  EXPECT_EQ(surfaces[1].device.usb_path, "1-2");
  EXPECT_EQ(surfaces[2].port, 9001);
  EXPECT_EQ(surfaces[3].map.control("stop")->chip, "gpiochip1");
  EXPECT_EQ(surfaces[4].driver, "mock");
}

TEST_F(SurfacesOfAStudio, NameTheNearestOfWhatIsNotThere) {
  EXPECT_NE(problem("fader 6: {level: hair}", "fader 9: {level: hair}").find("no control"),
            std::string::npos);
  EXPECT_NE(problem("fader 6: {level: hair}", "fader 6: {level: hare}").find("'hair'"),
            std::string::npos);
  EXPECT_NE(problem("map: generic/tablet", "map: generic/tablt").find("generic/tablet"),
            std::string::npos);
  EXPECT_NE(problem("map: generic/wall-box", "map: generic/tablet").find("is a map for osc"),
            std::string::npos);
  EXPECT_NE(problem("nobody: mock",
                    "nobody: {osc: {map: generic/tablet, interface: lo, port: "
                    "9001}}")
                .find("both listen on port 9001"),
            std::string::npos);
}

TEST_F(SurfacesOfAStudio, AnotherMapIsAnotherStudio) {
  std::filesystem::create_directories(folder_.path() / "surfaces/my");
  const auto with = [&](const std::string& deed) {
    std::ofstream(folder_.path() / "surfaces/my/box.yaml")
        << "surface: my/box\nmaker: M\ndevice: D\ndriver: gpio\ncontrols: {a: {line: 1, do: "
        << deed << "}}\n";
    const auto loaded =
        parse(support::edited(support::full_studio_text(), "map: generic/wall-box", "map: my/box"));
    return loaded ? loaded->studio.fingerprint : 0;
  };
  const auto first = with("blackout on");
  EXPECT_NE(first, 0u);
  EXPECT_NE(first, with("blackout"));
}

}  // namespace
}  // namespace chiaro::studio
