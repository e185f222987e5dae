// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Points by the million. The map's points are dealt out to tiles of the ground, so that those behind
// the camera are not drawn, and within a tile to layers, each of which is an even sample of the whole,
// so that a slow machine draws fewer of them. Points stand in blocks, which are filled one after
// another; only the new part of a block goes to the graphics card.
import {Box3, BufferAttribute, BufferGeometry, Color, DynamicDrawUsage, Group, Matrix4, Points,
  ShaderMaterial, Sphere, Vector3} from "./three.js";

export const NUM_LAYERS = 16;
const TILE_M = 64, FIRST_BLOCK = 256, LARGEST_BLOCK = 8192;  // points of a block: each has twice the last one's

// Software that draws without a graphics card spends nearly all of its time on the vertices, so that
// they have one product of a matrix and nothing else.
const VERTEX = `
uniform mat4 whole;
uniform float size, low, scale;
varying float height;
void main() {
  gl_Position = whole * vec4(position, 1.0);
  gl_PointSize = size;
  height = (position.z - low) * scale;
}`;
const FRAGMENT = `
uniform vec3 plain;
uniform bool isPlain;
varying float height;
vec3 byHeight(float h) {
  vec3 a = mix(vec3(0.16, 0.25, 0.62), vec3(0.12, 0.62, 0.72), clamp(h * 3.0, 0.0, 1.0));
  vec3 b = mix(a, vec3(0.45, 0.80, 0.38), clamp(h * 3.0 - 1.0, 0.0, 1.0));
  return mix(b, vec3(0.95, 0.78, 0.30), clamp(h * 3.0 - 2.0, 0.0, 1.0));
}
void main() { gl_FragColor = vec4(isPlain ? plain : byHeight(height), 1.0); }`;

function pointMaterial(size, colour) {
  return new ShaderMaterial({vertexShader: VERTEX, fragmentShader: FRAGMENT, uniforms: {
    size: {value: size}, low: {value: -2}, scale: {value: 0.1}, whole: {value: new Matrix4()},
    plain: {value: new Color(colour || "#ffffff").convertLinearToSRGB()}, isPlain: {value: Boolean(colour)}}});
}

class Block {
  constructor(material, capacity) {
    this.capacity = capacity;
    this.xyz = new BufferAttribute(new Float32Array(3 * capacity), 3).setUsage(DynamicDrawUsage);
    const geometry = new BufferGeometry().setAttribute("position", this.xyz);
    geometry.setDrawRange(0, 0);
    geometry.boundingSphere = new Sphere();
    this.box = new Box3();
    this.points = new Points(geometry, material);
    this.points.matrixAutoUpdate = false;
    this.num = 0;
  }
  add(x, y, z) {
    this.xyz.setXYZ(this.num++, x, y, z);
    const {min, max} = this.box;
    if (x < min.x) min.x = x;
    if (y < min.y) min.y = y;
    if (z < min.z) min.z = z;
    if (x > max.x) max.x = x;
    if (y > max.y) max.y = y;
    if (z > max.z) max.z = z;
  }
  // Uploads the points from `first` on.
  show(first) {
    this.xyz.addUpdateRange(3 * first, 3 * (this.num - first));
    this.xyz.needsUpdate = true;
    this.box.getBoundingSphere(this.points.geometry.boundingSphere);
    this.points.geometry.setDrawRange(0, this.num);
  }
}

export class GrowingCloud {
  constructor() {
    this.group = new Group();
    this.material = pointMaterial(1.5, null);
    this.clear();
    this.generation = 0;
    this.numLayers = NUM_LAYERS;
  }

  clear() {
    for (const block of this.blocks || []) block.points.geometry.dispose();
    this.group.clear();
    this.blocks = [];
    this.tiles = new Map();  // to the number of points, and the block of each layer that is not full
    this.num = 0;
    this.heights = [];
  }

  add({generation, first, points}) {
    if (generation !== this.generation || first !== this.num) this.clear();
    this.generation = generation;
    const shownFrom = new Map();
    for (let i = 0; i < points.length; i += 3, ++this.num) {
      const block = this.blockFor(points[i], points[i + 1]);
      if (!shownFrom.has(block)) shownFrom.set(block, block.num);
      block.add(points[i], points[i + 1], points[i + 2]);
      if (this.num % 37 === 0) this.heights.push(points[i + 2]);
    }
    for (const [block, from] of shownFrom) block.show(from);
    this.setColours();
  }

  blockFor(x, y) {
    const key = `${Math.floor(x / TILE_M)},${Math.floor(y / TILE_M)}`;
    let tile = this.tiles.get(key);
    if (!tile) this.tiles.set(key, tile = {num: 0, open: Array(NUM_LAYERS).fill(null)});
    const layer = tile.num++ % NUM_LAYERS, last = tile.open[layer];
    if (last && last.num < last.capacity) return last;
    const capacity = last ? Math.min(LARGEST_BLOCK, 2 * last.capacity) : FIRST_BLOCK;
    const block = tile.open[layer] = new Block(this.material, capacity);
    block.points.userData.layer = layer;
    block.points.visible = layer < this.numLayers;
    this.blocks.push(block);
    this.group.add(block.points);
    return block;
  }

  // Colours reach from the lowest to the highest points but for the outermost ones.
  setColours() {
    if (!this.heights.length) return;
    if (this.heights.length > 4000) this.heights = this.heights.filter((_, i) => i % 2);
    const sorted = Float32Array.from(this.heights).sort();
    const at = share => sorted[Math.floor(share * (sorted.length - 1))];
    this.material.uniforms.low.value = at(0.02);
    this.material.uniforms.scale.value = 1 / Math.max(1, at(0.98) - at(0.02));
  }

  // Draws so many of the layers.
  setLayers(num) {
    this.numLayers = num;
    for (const {points} of this.blocks) points.visible = points.userData.layer < num;
  }
}

export class ScanCloud {
  constructor() {
    this.material = pointMaterial(3, "#ff9f43");
    this.group = new Group();
    this.block = null;
    this.num = 0;
  }
  set(points) {
    const num = this.num = points.length / 3;
    if (!this.block || this.block.capacity < num) {
      if (this.block) this.block.points.geometry.dispose();
      this.group.clear();
      this.block = new Block(this.material, Math.max(4096, 2 * num));
      this.block.points.frustumCulled = false;
      this.group.add(this.block.points);
    }
    this.block.xyz.array.set(points);
    this.block.num = num;
    this.block.show(0);
  }
}
