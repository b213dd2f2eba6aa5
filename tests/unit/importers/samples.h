// SPDX-License-Identifier: Apache-2.0
// Small fixture and show files of our own making, for tests.
#pragma once

#include <string>

namespace chiaro::importers::samples {

/// A moving wash: 16 bit pan, tilt, dimmer with a fine byte that stands apart, shutter, zoom, RGBW by
/// two pixels that are geometry references, and a virtual channel. Red has a spectrum, white no data.
inline const std::string kGdtf = R"(<?xml version="1.0" encoding="UTF-8"?>
<GDTF DataVersion="1.2">
 <FixtureType Name="Wash Two" Manufacturer="Acme Lights" LongName="Wash Two" FixtureTypeID="1">
  <PhysicalDescriptions><Emitters>
   <Emitter Name="R" Color="0.69,0.31,20"><Measurement Physical="100" LuminousIntensity="300">
     <MeasurementPoint WaveLength="620" Energy="0"/><MeasurementPoint WaveLength="630" Energy="1"/>
     <MeasurementPoint WaveLength="640" Energy="0"/></Measurement></Emitter>
   <Emitter Name="G" Color="0.17,0.70,60"/>
   <Emitter Name="B" DominantWaveLength="460"/>
  </Emitters></PhysicalDescriptions>
  <Geometries>
   <Geometry Name="Base"><Axis Name="Yoke"><Axis Name="Head">
     <GeometryReference Name="P1" Geometry="Pixel"><Break DMXBreak="1" DMXOffset="11"/></GeometryReference>
     <GeometryReference Name="P2" Geometry="Pixel"><Break DMXBreak="1" DMXOffset="15"/></GeometryReference>
   </Axis></Axis></Geometry>
   <Beam Name="Pixel" LuminousFlux="4000" BeamAngle="18" FieldAngle="30" ColorTemperature="6000" BeamRadius="0.08"/>
  </Geometries>
  <DMXModes><DMXMode Name="Extended" Geometry="Base"><DMXChannels>
   <DMXChannel DMXBreak="1" Offset="1,2" Geometry="Yoke"><LogicalChannel Attribute="Pan"><ChannelFunction Attribute="Pan" DMXFrom="0/2" Default="32768/2" PhysicalFrom="-270" PhysicalTo="270"/></LogicalChannel></DMXChannel>
   <DMXChannel DMXBreak="1" Offset="3,4" Geometry="Head"><LogicalChannel Attribute="Tilt"><ChannelFunction Attribute="Tilt" DMXFrom="0/2" PhysicalFrom="-110" PhysicalTo="110"/></LogicalChannel></DMXChannel>
   <DMXChannel DMXBreak="1" Offset="5,8" Geometry="Head"><LogicalChannel Attribute="Dimmer"><ChannelFunction Attribute="Dimmer" DMXFrom="0/1" PhysicalFrom="0" PhysicalTo="1"/></LogicalChannel></DMXChannel>
   <DMXChannel DMXBreak="1" Offset="6" Geometry="Head"><LogicalChannel Attribute="Shutter1"><ChannelFunction Name="Closed" Attribute="Shutter1" DMXFrom="0/1" Default="32/1"/><ChannelFunction Name="Open" Attribute="Shutter1" DMXFrom="32/1"/><ChannelFunction Name="Strobe" Attribute="Shutter1Strobe" DMXFrom="64/1"/></LogicalChannel></DMXChannel>
   <DMXChannel DMXBreak="1" Offset="7" Geometry="Head"><LogicalChannel Attribute="Zoom"><ChannelFunction Attribute="Zoom" DMXFrom="0/1" PhysicalFrom="50" PhysicalTo="8"/></LogicalChannel></DMXChannel>
   <DMXChannel DMXBreak="1" Offset="9" Geometry="Head"><LogicalChannel Attribute="Gobo1"><ChannelFunction Attribute="Gobo1" DMXFrom="0/1" Default="3/1"/></LogicalChannel></DMXChannel>
   <DMXChannel DMXBreak="1" Offset="10" Geometry="Head"><LogicalChannel Attribute="NoFeature"><ChannelFunction Attribute="NoFeature" DMXFrom="0/1"/></LogicalChannel></DMXChannel>
   <DMXChannel DMXBreak="1" Offset="None" Geometry="Base"><LogicalChannel Attribute="Dimmer"><ChannelFunction Attribute="Dimmer" DMXFrom="0/1"/></LogicalChannel></DMXChannel>
   <DMXChannel DMXBreak="1" Offset="1" Geometry="Pixel"><LogicalChannel Attribute="ColorAdd_R"><ChannelFunction Attribute="ColorAdd_R" DMXFrom="0/1" Emitter="R"/></LogicalChannel></DMXChannel>
   <DMXChannel DMXBreak="1" Offset="2" Geometry="Pixel"><LogicalChannel Attribute="ColorAdd_G"><ChannelFunction Attribute="ColorAdd_G" DMXFrom="0/1" Emitter="G"/></LogicalChannel></DMXChannel>
   <DMXChannel DMXBreak="1" Offset="3" Geometry="Pixel"><LogicalChannel Attribute="ColorAdd_B"><ChannelFunction Attribute="ColorAdd_B" DMXFrom="0/1" Emitter="B"/></LogicalChannel></DMXChannel>
   <DMXChannel DMXBreak="1" Offset="4" Geometry="Pixel"><LogicalChannel Attribute="ColorAdd_W"><ChannelFunction Attribute="ColorAdd_W" DMXFrom="0/1"/></LogicalChannel></DMXChannel>
  </DMXChannels></DMXMode></DMXModes>
 </FixtureType>
</GDTF>
)";

/// A tunable panel with a 16 bit dimmer whose values count in 16 bit, and a bar of three RGB pixels.
inline const std::string kOfl = R"({
 "name": "Bar Three", "categories": ["Pixel Bar"], "manufacturerKey": "acme",
 "physical": {"dimensions": [900, 80, 60], "power": 60, "bulb": {"lumens": 2400}, "lens": {"degreesMinMax": [25, 25]}},
 "matrix": {"pixelKeys": [[["1", "2", "3"]]]},
 "availableChannels": {
  "Dimmer": {"fineChannelAliases": ["Dimmer fine"], "capability": {"type": "Intensity"}},
  "CCT": {"capabilities": [{"dmxRange": [0, 9], "type": "NoFunction"}, {"dmxRange": [10, 255], "type": "ColorTemperature", "colorTemperatureStart": "2800K", "colorTemperatureEnd": "10000K"}]},
  "Strobe": {"defaultValue": 12, "capabilities": [{"dmxRange": [0, 9], "type": "ShutterStrobe", "shutterEffect": "Closed"}, {"dmxRange": [10, 19], "type": "ShutterStrobe", "shutterEffect": "Open"}, {"dmxRange": [20, 255], "type": "ShutterStrobe", "shutterEffect": "Strobe"}]}
 },
 "templateChannels": {
  "Red $pixelKey": {"capability": {"type": "ColorIntensity", "color": "Red"}},
  "Green $pixelKey": {"capability": {"type": "ColorIntensity", "color": "Green"}},
  "Blue $pixelKey": {"capability": {"type": "ColorIntensity", "color": "Blue"}}
 },
 "modes": [
  {"name": "White", "channels": ["Dimmer", "Dimmer fine", null, "CCT", "Strobe"]},
  {"name": "Pixels", "channels": ["Dimmer", "Strobe", {"insert": "matrixChannels", "repeatFor": "eachPixelABC", "channelOrder": "perPixel", "templateChannels": ["Red $pixelKey", "Green $pixelKey", "Blue $pixelKey"]}]}
 ]
})";

inline const std::string kQxw = R"(<?xml version="1.0" encoding="UTF-8"?>
<Workspace><Engine>
 <Fixture><Manufacturer>Generic</Manufacturer><Model>Generic</Model><Mode>Generic</Mode><ID>0</ID><Name>Rack</Name><Universe>0</Universe><Address>9</Address><Channels>2</Channels></Fixture>
 <Fixture><Manufacturer>Nobody</Manufacturer><Model>Ghost</Model><Mode>M</Mode><ID>1</ID><Name>Ghost</Name><Universe>1</Universe><Address>0</Address><Channels>4</Channels></Fixture>
 <Function Type="Scene" Name="Warm"><FixtureVal ID="0">0,255,1,128,7,3</FixtureVal></Function>
 <Function Type="Chaser" Name="Run"/><Function Type="Chaser" Name="Run 2"/>
</Engine><VirtualConsole/></Workspace>
)";

}  // namespace chiaro::importers::samples
