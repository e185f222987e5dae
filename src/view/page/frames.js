// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Reads the binary frames of lio-view; src/view/frame_writer.hpp has their layout.
const MAGIC = 0x3156494c;
const ROW_VALUES = 11;
export const STATE_VALUES = ["vx", "vy", "vz", "gx", "gy", "gz", "ax", "ay", "az", "nis"];

class Reader {
  constructor(buffer, begin, size) {
    this.view = new DataView(buffer, begin, size);
    this.at = 0;
  }
  u32() { this.at += 4; return this.view.getUint32(this.at - 4, true); }
  f32() { this.at += 4; return this.view.getFloat32(this.at - 4, true); }
  f64() { this.at += 8; return this.view.getFloat64(this.at - 8, true); }
  floats(count) { return Array.from({length: count}, () => this.f32()); }
  range() { return {generation: this.u32(), first: this.u32(), total: this.u32()}; }
  // The points as x, y, z one behind another.
  points() {
    const count = this.u32(), [x0, y0, z0] = this.floats(3), step = this.f32();
    const xyz = new Float32Array(3 * count), {view} = this;
    for (let i = 0, at = this.at; i < 3 * count; i += 3, at += 6) {
      xyz[i] = x0 + step * view.getUint16(at, true);
      xyz[i + 1] = y0 + step * view.getUint16(at + 2, true);
      xyz[i + 2] = z0 + step * view.getUint16(at + 4, true);
    }
    this.at += 6 * count;
    return xyz;
  }
  json() {
    const {buffer, byteOffset, byteLength} = this.view;
    return JSON.parse(new TextDecoder().decode(new Uint8Array(buffer, byteOffset, byteLength)));
  }
}

const SECTIONS = {
  1: ["hello", r => r.json()],
  2: ["map", r => ({...r.range(), voxel: r.f32(), points: r.points()})],
  3: ["scan", r => ({number: r.u32(), leftOut: r.u32(), points: r.points()})],
  4: ["path", r => {
    const range = r.range(), count = r.u32();
    return {...range, count, rows: r.floats(4 * count)};
  }],
  5: ["pose", r => ({stamp: r.f64(), received: r.f64(), position: r.floats(3), rotation: r.floats(4),
    axes: r.floats(4), std: r.floats(3), velocity: r.floats(3), status: r.f32(), leftOut: r.u32()})],
  6: ["states", r => {
    const range = r.range(), count = r.u32(), begin = r.f64();
    return {...range, count, begin, rows: Array.from({length: count}, () => r.floats(ROW_VALUES))};
  }],
  7: ["status", r => r.json()],
  8: ["timeline", r => r.json()],
};

// Calls take[NAME](content) for each section of the frame; a kind that is not known is skipped.
export function readFrame(buffer, take) {
  const whole = new DataView(buffer);
  if (buffer.byteLength < 4 || whole.getUint32(0, true) !== MAGIC) throw new Error("not a frame of lio-view");
  for (let at = 4; at + 8 <= buffer.byteLength;) {
    const kind = whole.getUint32(at, true), size = whole.getUint32(at + 4, true);
    const [name, read] = SECTIONS[kind] || [];
    if (name) take[name](read(new Reader(buffer, at + 8, size)));
    at += 8 + 4 * Math.ceil(size / 4);
  }
}
