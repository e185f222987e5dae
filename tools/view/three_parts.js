// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// The page of lio-view uses these parts of three.js; tools/view/bundle.sh makes one file of them.
export {
  AxesHelper, Box3, BufferAttribute, BufferGeometry, Color, DataTexture, DynamicDrawUsage, Group,
  Line, LineBasicMaterial, LineSegments, Matrix4, Mesh, MeshBasicMaterial, OrthographicCamera,
  PerspectiveCamera, Points, Scene, ShaderMaterial, Sphere, SphereGeometry, Vector3, WebGLRenderer,
  WireframeGeometry,
} from "three";
export {OrbitControls} from "three/addons/controls/OrbitControls.js";
