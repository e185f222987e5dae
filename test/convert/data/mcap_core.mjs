// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Wrote mcap_core.mcap, with Node.js and @mcap/core 2.2.2 of npm:
//     npm install @mcap/core@2.2.2 && node mcap_core.mjs mcap_core.mcap
// 100 messages of ROS 2 on two topics, in chunks of 1 kB with checksums, message indices, an
// attachment, metadata and a summary.
import { McapWriter } from "@mcap/core";
import { writeFileSync } from "fs";

const parts = [];
let size = 0n;
const writable = {
  position: () => size,
  write: async (bytes) => {
    parts.push(Buffer.from(bytes));
    size += BigInt(bytes.byteLength);
  },
};
const writer = new McapWriter({ writable, chunkSize: 1024 });
const text = new TextEncoder();

async function channel(topic, name, definition) {
  const data = text.encode(definition);
  const schemaId = await writer.registerSchema({ name, encoding: "ros2msg", data });
  const metadata = new Map([["offered_qos_profiles", ""]]);
  return writer.registerChannel({ schemaId, topic, messageEncoding: "cdr", metadata });
}

await writer.start({ profile: "ros2", library: "" });
const bytes = await channel("/byte", "std_msgs/msg/Byte", "byte data\n");
const numbers = await channel("/uint16", "std_msgs/msg/UInt16", "uint16 data\n");
const note = { name: "note.txt", mediaType: "text/plain", logTime: 5n, createTime: 5n };
await writer.addAttachment({ ...note, data: text.encode("an attachment") });
for (let i = 0; i < 100; ++i) {
  const logTime = 1600000000000000000n + BigInt(i) * 10000000n;
  const isByte = i % 2 === 0;
  const data = new Uint8Array([0, 1, 0, 0, i].concat(isByte ? [] : [0]));
  const channelId = isByte ? bytes : numbers;
  await writer.addMessage({ channelId, sequence: i, logTime, publishTime: logTime, data });
}
await writer.addMetadata({ name: "rosbag2", metadata: new Map([["key", "value"]]) });
await writer.end();
writeFileSync(process.argv[2], Buffer.concat(parts));
