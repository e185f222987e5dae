// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// The path, coloured by status, and the pose with its ellipsoid of three standard deviations.
import {AxesHelper, BufferAttribute, BufferGeometry, Color, DynamicDrawUsage, Group, Line,
  LineBasicMaterial, LineSegments, Mesh, MeshBasicMaterial, SphereGeometry,
  WireframeGeometry} from "./three.js";

export const STATUS_COLOURS = ["#8a94a0", "#22d3ee", "#f7b731", "#ff8c42", "#ff5c5c"];
const SIGMAS = 3;
const rgb = STATUS_COLOURS.map(colour => new Color(colour));

export class PathLine {
  constructor() {
    this.material = new LineBasicMaterial({vertexColors: true});
    this.line = new Line(new BufferGeometry(), this.material);
    this.line.frustumCulled = false;
    this.generation = 0;
    this.reserve(1024);
    this.num = 0;
  }

  reserve(capacity) {
    const grown = values => {
      const attribute = new BufferAttribute(new Float32Array(3 * capacity), 3).setUsage(DynamicDrawUsage);
      if (values) attribute.array.set(values.array.subarray(0, 3 * this.num));
      return attribute;
    };
    this.line.geometry.dispose();
    this.capacity = capacity;
    this.xyz = grown(this.xyz);
    this.rgb = grown(this.rgb);
    this.line.geometry = new BufferGeometry().setAttribute("position", this.xyz).setAttribute("color", this.rgb);
  }

  add({generation, first, count, rows}) {
    if (generation !== this.generation || first !== this.num) this.num = 0;
    this.generation = generation;
    if (this.num + count > this.capacity) this.reserve(2 * (this.num + count));
    const from = this.num;
    for (let i = 0; i < count; ++i, ++this.num) {
      const [x, y, z, status] = rows.slice(4 * i, 4 * i + 4);
      this.xyz.setXYZ(this.num, x, y, z);
      const colour = rgb[status] || rgb[0];
      this.rgb.setXYZ(this.num, colour.r, colour.g, colour.b);
    }
    for (const attribute of [this.xyz, this.rgb]) {
      attribute.addUpdateRange(3 * from, 3 * (this.num - from));
      attribute.needsUpdate = true;
    }
    this.line.geometry.setDrawRange(0, this.num);
  }
}

export class PoseMark {
  constructor() {
    this.group = new Group();
    this.axes = new AxesHelper(2);
    const sphere = new SphereGeometry(1, 24, 16);
    this.ellipsoid = new Group();
    this.ellipsoid.add(
      new Mesh(sphere, new MeshBasicMaterial({color: "#c77dff", transparent: true, opacity: 0.28, depthWrite: false})),
      new LineSegments(new WireframeGeometry(new SphereGeometry(1, 12, 8)),
        new LineBasicMaterial({color: "#d7a8ff", transparent: true, opacity: 0.5})));
    this.group.add(this.axes, this.ellipsoid);
    this.group.visible = false;
  }
  set({position, rotation, axes, std}) {
    this.group.visible = true;
    this.group.position.set(...position);
    this.axes.quaternion.set(...rotation);
    this.ellipsoid.quaternion.set(...axes);
    this.ellipsoid.scale.set(...std.map(s => Math.max(1e-4, SIGMAS * s)));
  }
}
