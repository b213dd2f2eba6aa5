// SPDX-License-Identifier: Apache-2.0
// Listens to sACN with somebody else's receiver and prints each packet as one line of JSON: what
// our bytes mean to others. Usage: sacn_receiver.mjs UNIVERSE INTERFACE_ADDRESS [PACKETS]
import sacn from 'sacn';

const [universe, address, packets] = process.argv.slice(2);
const receiver = new sacn.Receiver({
  universes: [Number(universe)], iface: address, reuseAddr: true,
});
let seen = 0;
const say = (line) => process.stdout.write(JSON.stringify(line) + '\n');

receiver.on('packet', (packet) => {
  say({
    universe: packet.universe,
    sequence: packet.sequence,
    priority: packet.priority,
    source: packet.sourceName,
    cid: packet.cid.toString('hex'),
    terminated: (packet.options & 0x40) !== 0,
    levels: [...packet.payloadAsBuffer],
  });
  if (packets && ++seen >= Number(packets)) receiver.close(() => process.exit(0));
});
receiver.on('PacketCorruption', (error) => say({problem: error.message}));
receiver.on('PacketOutOfOrder', (error) => say({problem: error.message}));
receiver.on('error', (error) => {
  say({problem: error.message});
  process.exit(1);
});
receiver.socket.on('listening', () => say({listening: true}));
process.on('SIGTERM', () => receiver.close(() => process.exit(0)));
