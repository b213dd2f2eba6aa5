// SPDX-License-Identifier: Apache-2.0
// The studio as a value: everything that exists in it, as its YAML file says. Inside units:
// metres, radians, seconds, kelvin; frame: right-handed, Z up.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "controller/core/colour.h"
#include "controller/core/dof.h"
#include "controller/core/geometry.h"
#include "controller/core/picture.h"
#include "controller/core/result.h"
#include "controller/core/units.h"
#include "controller/studio/profile.h"
#include "controller/studio/register_map.h"
#include "controller/studio/surface_map.h"

namespace chiaro::studio {

struct Material {
  core::Rgb diffuse{0.5, 0.5, 0.5};
  double specular = 0;
  double shininess = 16;
};

enum class UpAxis { by_format, y, z };

struct Subject {
  std::string name;            ///< "subject" when the file names none
  std::filesystem::path mesh;  ///< absolute; the shipped bust for `stand_in: person`
  bool stand_in = false;
  double eye_height = 0;         ///< stand_in only; 0 = not given
  std::optional<double> height;  ///< scaled to this; as modelled when absent
  core::Vec3 at;                 ///< where its base stands
  double facing = 0;             ///< 0 = towards the main camera, positive to the camera's right
  UpAxis up = UpAxis::by_format;
  std::optional<core::Vec3> front;   ///< model-space axis that is the subject's front
  std::optional<Material> material;  ///< overrides the file's materials
  std::optional<core::Vec3> aim;     ///< studio frame; else the head's centre, else the mesh's
  core::Place place;
};

struct BackgroundPlane {
  std::string name;
  core::Vec3 through, normal{0, 0, 1};
  double width = 0, height = 0;  ///< 0 = unbounded
  Material material;
  core::Place place;
};

struct Camera {
  std::string name;
  core::Vec3 at, look_at;
  double vertical_fov = core::radians(30);
  core::Size size{640, 480};
  std::optional<double> shutter_s, aperture_f, iso;  ///< all three or none: override grey_card
  bool lamps_may_show = false;
  std::string source;  ///< "http://…", "file:…", "v4l2:…"; empty = none
  core::Place place;
};

struct Exposure {
  core::Lux grey_card{800};  ///< illuminance at which an 18 % card renders as L* 50
  core::Kelvin white_balance{5600};
};

struct Ambient {
  core::Lux illuminance{0};  ///< everywhere, from every side
  core::Kelvin cct{5600};
  std::filesystem::path measured;  ///< a linear frame of the studio with the lamps off
};

struct Region {
  core::Range azimuth{-core::kPi, core::kPi}, elevation{-core::kPi / 2, core::kPi / 2},
      distance{0.6, 10};
};

struct FixedMount {
  core::Vec3 at, aim_at;
};
/// Moved by a person; always aimed at the subject's aim.
struct StandMount {
  core::Spherical at;  ///< where it stands now ("placed")
  Region region;
};
/// Where an axis is on the wire: slots that carry its whole range, most significant first.
struct AxisWire {
  std::uint16_t universe = 0;  ///< 0 = the lamp's own patch; else of a motor with its own address
  int slot = 0;                ///< 1.. within the lamp's patch, else 1..512; 0 = no wire
  int bytes = 1;
};
/// Motorised along a circle about `centre` in a plane; the lamp aims at the subject.
struct ArcMount {
  core::Vec3 centre;
  double radius = 1;
  core::Range angle;  ///< radians
  double at = 0;
  bool vertical = false;  ///< else horizontal
  AxisWire axis;
};
struct TrackMount {
  core::Vec3 from, to;
  double at = 0;  ///< 0..1 along it
  AxisWire axis;
};
/// A yoke with its pan axis upright. The DOFs pan and tilt count from the neutral aim: pan to the
/// left seen from above, tilt upwards, through the pole and on.
struct PanTiltMount {
  core::Vec3 at, aim_at;  ///< neutral aim
  core::Range pan{-core::kPi, core::kPi}, tilt{-core::kPi / 2, core::kPi / 2};
  double head_pan = 0, head_tilt = 0;  ///< the head's own angles when it aims at `aim_at`
  bool invert_pan = false;             ///< the head counts pan to the right seen from above
  bool invert_tilt = false;            ///< the head counts tilt downwards
  bool swap = false;                   ///< its pan channel tilts and its tilt channel pans
};
/// The thesis's free lamp on a sphere about the aim; constrained by default to the quarter sphere
/// above and in front [I-5]. Diffuse and specular levels may differ on it alone.
struct VirtualMount {
  core::Spherical at{0, core::radians(30), 2};
  Region region{{-core::kPi / 2, core::kPi / 2}, {0, core::kPi / 2}, {2, 2}};
  bool separate_specular = false;
};
using Mount =
    std::variant<FixedMount, StandMount, ArcMount, TrackMount, PanTiltMount, VirtualMount>;

enum class Role { key, fill, back, hair, kicker, background, practical };
std::string_view name_of(Role role);

struct Modifier {
  std::string name;              ///< "bare", "softbox", "umbrella", "grid"
  double width = 0, height = 0;  ///< the new emitting rectangle; 0 = the bare optic
  double loss_stops = 0;
};

struct DmxPatch {
  std::uint16_t universe = 1;
  std::uint16_t address = 1;  ///< 1..512
};
struct ModbusPatch {
  std::string bus;
  std::uint16_t register_number = 0;
};
/// No wire: a practical, or a lamp set by hand.
struct NoPatch {};
using Patch = std::variant<NoPatch, DmxPatch, ModbusPatch>;

/// What a person sets on the lamp itself; results for it become instructions.
enum class HandKind { knob, gel, flash_power, stand };
struct HandBinding {
  core::Dof dof;
  HandKind kind;
  std::optional<core::Range> range;  ///< inside units; the profile's when absent
};

struct Limits {
  double most = 1;                ///< intensity
  double slew_per_s = 0;          ///< fraction of full per second; 0 = unlimited
  double safe_level = 0;          ///< what `fade_to_safe` goes to
  bool ignores_blackout = false;  ///< house and safety light
  double end_to_end_s = 10;       ///< the least time in which an axis may cross its whole range
};

struct Fixture {
  std::string name;
  Role role = Role::key;
  Profile profile;                  ///< a copy: a studio is self-contained
  std::size_t mode = 0;             ///< index into profile.modes
  core::Candela output{0};          ///< at full, bare
  std::vector<Modifier> modifiers;  ///< the first is fitted now; empty = bare
  Mount mount;
  Patch patch;
  Limits limits;
  DimmerCurve curve;                 ///< the patch's; the profile's unless the file overrides it
  std::vector<HandBinding> by_hand;  ///< a stand mount's place is always among them
  bool controlled = true;            ///< false: an uncontrolled practical: included, never changed
  core::FixtureState initial;        ///< level and colour when nothing has been said
  core::Place place;
  core::Place patch_place;

  /// Optic and output with the fitted modifier applied.
  Optic fitted_optic() const;
  core::Candela fitted_output() const;
  /// Every DOF that this fixture has at all, with its range (inside units): intensity up to its
  /// limit, what the patched mode or a hand can set of colour and zoom, what the mount can move.
  /// Nothing for an uncontrolled fixture.
  std::vector<std::pair<core::Dof, core::Range>> ranges() const;
  /// The channels of the patched mode as they act on this lamp as it is mounted: a head's pan and
  /// tilt in the mount's angles, and the channel of an arc's or a track's motor after the mode's
  /// own. What encodes, decodes and counts slots goes by these. A motor with an address of its own
  /// is `far_motor`'s.
  std::vector<Channel> wired_channels() const;
  /// The channel of a motor that is patched apart from its lamp, offset 0 at that address.
  struct FarMotor {
    Channel channel;
    DmxPatch patch;
  };
  std::optional<FarMotor> far_motor() const;
  /// Slots from the address on, the motor's included; at least 1.
  int footprint() const;
};

struct SacnOutput {
  std::string interface;
  double rate_hz = 40;
  int priority = 100;
  std::string unicast;     ///< "" = multicast
  std::uint16_t sync = 0;  ///< synchronisation universe; 0 = none
  bool quiet = false;      ///< unchanged levels only every 0.8 s
};
struct MockOutput {
  double rate_hz = 40;
};
struct ArtNetOutput {
  std::string interface;
  double rate_hz = 40;
  int port_address = -1;  ///< -1 = universe - 1
  std::string unicast;    ///< "" = to the nodes that ask for it
  bool broadcast = false, sync = false, quiet = false;
};
/// One plugged-in device; empty fields match any. At least one is given.
struct DeviceName {
  std::string node;                       ///< "/dev/ttyUSB0"
  std::uint16_t vendor = 0, product = 0;  ///< USB ids
  std::string serial, usb_path;
};
/// Enttec DMX USB Pro and what speaks its protocol.
struct UsbProOutput {
  DeviceName device;
  double rate_hz = 40;
  int port = 1, break_us = 176, mab_us = 16;
};
/// An FTDI chip alone: the computer times every frame.
struct OpenDmxOutput {
  DeviceName device;
  double rate_hz = 30;
  int slots = 512, break_us = 176, mab_us = 16;
};
struct UdmxOutput {
  DeviceName device;
  double rate_hz = 30;
  int slots = 512;
};
struct OlaOutput {
  double rate_hz = 40;
  std::uint16_t universe = 0;  ///< olad's own number; 0 = the same
};
/// A device on one of the studio's buses, as a universe whose slots are its channels.
struct ModbusOutput {
  double rate_hz = 20;  ///< how often levels are laid down; the bus takes what it can
  std::string bus;
  int unit = 1;
  RegisterMap map;
};
using OutputDriver = std::variant<SacnOutput, MockOutput, ArtNetOutput, UsbProOutput, OpenDmxOutput,
                                  UdmxOutput, OlaOutput, ModbusOutput>;
/// "sACN on eth0 at 40 Hz, priority 100".
std::string output_in_words(const OutputDriver& driver);
double rate_of(const OutputDriver& driver);
struct Output {
  std::uint16_t universe = 1;
  OutputDriver driver;
  core::Place place;
};

struct Bus {
  std::string name;
  std::string device;  ///< "tcp://host:502" or "/dev/…"
  int baud = 9600;
  core::Place place;
  DeviceName adapter{};  ///< serial: which one, by node, USB ids, serial number or socket
  char parity = 'N';     ///< 'N', 'E' or 'O'
  int stop_bits = 1;
};

/// Buttons, faders and lamps that people use; the output process listens to them.
struct Surface {
  std::string name;
  std::string driver;     ///< "gpio", "hid", "midi", "osc" or "mock"
  DeviceName device{};    ///< HID
  std::string midi_name;  ///< part of it
  std::string interface;  ///< OSC
  std::uint16_t port = 9000;
  SurfaceMap map;
  core::Place place;
};

/// Lamps behind one fuse, and what it bears.
struct Circuit {
  std::string name;
  double limit_w = 0;
  struct Load {
    std::size_t fixture = 0;  ///< index into Studio::fixtures
    double watts = 0;         ///< at full
  };
  std::vector<Load> loads;
  /// Dimmed filament lamps: half the light still takes 72 % of the power. LED lamps: half.
  bool tungsten = false;
  core::Place place;
};

/// Where people are or pass: no axis may carry a lamp into it. Subjects have theirs without asking.
struct KeepOut {
  std::string name;
  core::Vec3 at;
  double radius = 1;  ///< metres
  core::Place place;
};

/// What happens when the brain falls silent and at power-up.
struct Safety {
  std::optional<double> fade_to_safe_after_s;  ///< none = hold for ever
  double fade_to_safe_s = 5;
  enum class PowerUp { last, dark };
  PowerUp power_up = PowerUp::last;
};

struct Studio {
  std::string name;
  std::filesystem::path file;
  std::uint64_t fingerprint = 0;  ///< of the content of the file, its profiles and its maps
  std::vector<Subject> subjects;
  std::vector<BackgroundPlane> background;
  std::optional<double> ceiling;  ///< metres
  std::vector<Camera> cameras;    ///< the first is "main"
  std::vector<Fixture> fixtures;
  std::vector<Output> outputs;
  std::vector<Bus> buses;
  std::vector<Circuit> circuits;
  std::vector<KeepOut> keep_out;
  std::vector<Surface> surfaces;
  Exposure exposure;
  std::optional<Ambient> ambient;
  Safety safety;

  const Camera& main_camera() const { return cameras.front(); }
  const Fixture* fixture(std::string_view name) const;
  std::optional<std::size_t> fixture_index(std::string_view name) const;
};

/// What its surfaces may ask of the brain (looks, moods, nudges), in the order of the file: brain
/// and output process count them alike.
std::vector<Deed> asked_of_brain(const Studio& studio);

/// A value for every DOF of the studio; states[i] belongs to studio.fixtures[i].
struct Rig {
  std::vector<core::FixtureState> states;
  friend bool operator==(const Rig&, const Rig&) = default;
};
/// The rig as it stands: mounts as placed, levels and colours initial.
Rig placed_rig(const Studio& studio);

/// Display-linear value per lux falling on a perfect white diffuser: with albedo rho and E lux a
/// pixel becomes rho * E * exposure_gain. Camera shutter/aperture/ISO win over grey_card
/// (incident-meter constant C = 250, ISO 2720).
double exposure_gain(const Exposure& exposure, const Camera& camera);

/// Linear sRGB of the fixture's light in that state, *without* intensity, as the balanced camera
/// sees it; luminance is 1 at the profile's white, less where the mix gives less light.
core::Rgb light_colour(const Fixture& fixture, const core::FixtureState& state,
                       core::Kelvin balance);

}  // namespace chiaro::studio
