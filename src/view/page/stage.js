// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// The scene, its two cameras and the drawing of frames. A frame is drawn when something changed; on a
// machine that is slow at it fewer of the map's points are drawn.
import {BufferAttribute, BufferGeometry, LineBasicMaterial, LineSegments, OrbitControls,
  OrthographicCamera, PerspectiveCamera, Scene, Vector3, WebGLRenderer} from "./three.js";
import {GrowingCloud, NUM_LAYERS, ScanCloud} from "./cloud.js";
import {isSoftware, Splats} from "./splats.js";
import {PathLine, PoseMark} from "./track.js";

const SLOW_MS = 55, FAST_MS = 36;  // below 18 and above 28 frames a second
const ADAPT_MS = 500;
const ABOVE_M = 60;                // half the height of the view from above

const CELL_M = 10, CELLS = 20;     // the grid's, to each side

// The ground in cells of 10 m. Each edge of a cell is a line of its own, because software that draws
// lines drops those that reach behind the camera.
function makeGrid() {
  const ends = [];
  for (let i = -CELLS; i <= CELLS; ++i) {
    for (let j = -CELLS; j < CELLS; ++j) ends.push(i, j, 0, i, j + 1, 0, j, i, 0, j + 1, i, 0);
  }
  const xyz = new BufferAttribute(Float32Array.from(ends, end => CELL_M * end), 3);
  return new LineSegments(new BufferGeometry().setAttribute("position", xyz),
    new LineBasicMaterial({color: "#262e37"}));
}

export class Stage {
  constructor(canvas) {
    this.canvas = canvas;
    this.renderer = new WebGLRenderer({canvas, antialias: false, powerPreference: "high-performance"});
    this.renderer.setClearColor("#0b0e12");
    this.scene = new Scene();
    this.map = new GrowingCloud();
    this.scan = new ScanCloud();
    this.path = new PathLine();
    this.mark = new PoseMark();
    this.grid = makeGrid();
    this.splats = isSoftware(this.renderer.getContext()) ? new Splats() : null;
    this.scene.add(this.splats ? this.splats.mesh : this.map.group, this.grid, this.scan.group, this.path.line, this.mark.group);
    this.makeCameras();
    Object.assign(this, {follows: true, isDirty: true, numDrawn: 0, frameMs: 16, lastDrawn: 0, lastAdapted: 0,
      isFixed: false});
    addEventListener("resize", () => this.resize());
    this.resize();
    requestAnimationFrame(now => this.tick(now));
  }

  makeCameras() {
    const whole = new PerspectiveCamera(55, 1, 0.1, 5000), above = new OrthographicCamera(-1, 1, 1, -1, 0.1, 5000);
    for (const camera of [whole, above]) camera.up.set(0, 0, 1);
    whole.position.set(-18, -18, 22);
    above.up.set(0, 1, 0);
    above.position.set(0, 0, 1000);
    this.views = [whole, above].map(camera => {
      const controls = new OrbitControls(camera, this.canvas);
      controls.enabled = false;
      controls.addEventListener("change", () => this.touch());
      controls.addEventListener("start", () => { this.isHeld = true; });
      controls.addEventListener("end", () => { this.isHeld = false; });
      return {camera, controls};
    });
    this.views[1].controls.enableRotate = false;
    this.views[1].controls.screenSpacePanning = true;
    this.look(0);
  }

  look(index) {
    for (const {controls} of this.views) controls.enabled = false;
    this.view = this.views[index];
    this.view.controls.enabled = true;
    this.touch();
  }
  get camera() { return this.view.camera; }

  touch() { this.isDirty = true; }

  resize() {
    const {clientWidth: width, clientHeight: height} = this.canvas;
    this.renderer.setPixelRatio(Math.min(2, devicePixelRatio));
    this.renderer.setSize(width, height, false);
    this.splats?.resize(this.canvas.width, this.canvas.height);
    const [whole, above] = this.views.map(view => view.camera);
    whole.aspect = width / Math.max(1, height);
    Object.assign(above, {left: -ABOVE_M * whole.aspect, right: ABOVE_M * whole.aspect, top: ABOVE_M, bottom: -ABOVE_M});
    for (const camera of [whole, above]) camera.updateProjectionMatrix();
    for (const cloud of [this.map, this.scan]) {
      cloud.material.uniforms.size.value = (cloud === this.map ? 1.5 : 2.5) * Math.min(2, devicePixelRatio);
    }
    this.touch();
  }

  setPose(pose) {
    this.mark.set(pose);
    const at = new Vector3(...pose.position);
    if (this.follows) {
      for (const {camera, controls} of this.views) {
        const step = at.clone().sub(controls.target);
        controls.target.add(step);
        camera.position.add(step);
      }
    }
    this.grid.position.set(CELL_M * Math.round(at.x / CELL_M), CELL_M * Math.round(at.y / CELL_M), 0);
    this.touch();
  }

  tick(now) {
    requestAnimationFrame(next => this.tick(next));
    this.view.controls.update();
    if (!this.isDirty) {
      this.lastDrawn = 0;
      return;
    }
    this.isDirty = false;
    this.draw();
    ++this.numDrawn;
    if (this.lastDrawn) this.frameMs += 0.2 * (Math.min(1000, now - this.lastDrawn) - this.frameMs);
    this.lastDrawn = now;
    this.adapt(now);
  }

  draw() {
    this.camera.updateMatrixWorld();
    for (const {material} of [this.map, this.scan]) {
      material.uniforms.whole.value.multiplyMatrices(this.camera.projectionMatrix, this.camera.matrixWorldInverse);
    }
    this.drawSplats();
    this.renderer.render(this.scene, this.camera);
  }

  drawSplats() {
    if (!this.splats) return;
    const {whole, low, scale} = this.map.material.uniforms;
    this.splats.mesh.visible = this.map.group.visible;
    if (this.map.group.visible) this.splats.draw(this.map.blocks, whole.value.elements, low.value, scale.value);
  }

  // Draws fewer layers of the map where frames take long, and more where there is time.
  adapt(now) {
    if (this.isFixed || now - this.lastAdapted < ADAPT_MS) return;
    this.lastAdapted = now;
    const {numLayers} = this.map;
    const least = this.splats ? NUM_LAYERS / 2 : 1;  // fewer would hardly be faster
    if (this.frameMs > SLOW_MS) this.map.setLayers(Math.max(least, Math.floor(numLayers * Math.max(0.5, SLOW_MS / this.frameMs))));
    else if (this.frameMs < FAST_MS && numLayers < NUM_LAYERS) this.map.setLayers(numLayers + 1);
  }

  // The pixel of the canvas, in CSS pixels, at which a point of the map stands.
  pixelOf(point) {
    const {clientWidth, clientHeight} = this.canvas;
    this.camera.updateMatrixWorld();
    const p = new Vector3(...point).project(this.camera);
    return [(p.x + 1) / 2 * clientWidth, (1 - p.y) / 2 * clientHeight];
  }
}
