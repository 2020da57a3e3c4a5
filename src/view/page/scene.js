// SPDX-License-Identifier: MIT
// The picture: particles as their deformed domains, blocks with their edges, broken bonds, arrows, and the camera.

import { ball, arrow, cube, Glyphs, square } from "./glyphs.js";
import { Furniture } from "./furniture.js";
import { Layers } from "./layers.js";
import { Motion, thinned } from "./motion.js";
import { isCategory, lookupTable } from "./colours.js";

const manipulators = flat => {
  const { vtkMouseCameraTrackballPanManipulator: Pan, vtkMouseCameraTrackballRotateManipulator: Rotate, vtkMouseCameraTrackballZoomManipulator: Zoom,
    vtkMouseCameraTrackballZoomToMouseManipulator: ZoomHere, vtkGestureCameraManipulator: Gesture } = vtk.Interaction.Manipulators;
  const mouse = flat ? [Pan.newInstance({ button: 1 }), Zoom.newInstance({ button: 3 })]
    : [Rotate.newInstance({ button: 1 }), Pan.newInstance({ button: 1, shift: true }), Pan.newInstance({ button: 2 }), Zoom.newInstance({ button: 3 })];
  return { mouse: [...mouse, ZoomHere.newInstance({ scrollEnabled: true, dragEnabled: false })], gesture: Gesture.newInstance() };
};

export const cameras = {
  plane: { "x, y": [[0, 0, 1], [0, 1, 0]] },
  space: {
    "iso": [[0.55, 0.45, 0.75], [0, 1, 0]], "iso z": [[0.75, -0.55, 0.45], [0, 0, 1]], "x, y": [[0, 0, 1], [0, 1, 0]],
    "x, z": [[0, -1, 0], [0, 0, 1]], "y, z": [[1, 0, 0], [0, 0, 1]]
  }
};

export class Scene {
  constructor(parent) {
    this.window = vtk.Rendering.Misc.vtkGenericRenderWindow.newInstance({ background: [1, 1, 1] });
    this.window.setContainer(parent);
    this.window.resize();
    this.renderer = this.window.getRenderer();
    this.particles = new Glyphs(this.renderer, square());
    this.behind = new Glyphs(this.renderer, square());
    this.behind.actor.setPickable(false);
    this.behind.actor.getProperty().setLighting(false);
    this.blocks = this.polygons();
    this.blocks.actor.getProperty().set({ edgeVisibility: true, edgeColor: [0.25, 0.25, 0.25], lineWidth: 1 });
    for (const [how, colour] of [["torn", [0.84, 0.15, 0.16]], ["sheared", [0.12, 0.35, 0.78]], ["crack", [0.84, 0.2, 0.52]]]) {
      this[how] = this.polygons();
      this[how].actor.getProperty().set({ color: colour, lineWidth: 3, lighting: false });
      this[how].actor.setPickable(false);
      this[how].mapper.set({ scalarVisibility: false });
    }
    this.arrows = new Glyphs(this.renderer, arrow(true));
    this.arrows.actor.setPickable(false);
    this.arrows.actor.getProperty().set({ color: [0.92, 0.38, 0.05] });
    this.layers = new Layers(this.renderer);
    this.furniture = new Furniture(this.renderer, this.window.getInteractor());
    this.light();
    this.motion = new Motion(this.window.getInteractor(), most => this.drawParticles(most), coarse => this.setCoarse(coarse));
    this.fresh = true;
    this.sized = new ResizeObserver(() => { this.window.resize(); if (this.untouched) this.fit(); else this.render(); });
    this.sized.observe(parent);
    for (const kind of ["onStartMouseWheel", "onLeftButtonPress", "onRightButtonPress"])
      this.window.getInteractor()[kind]?.(() => { this.untouched = false; });
  }
  // One light from the eye, and one from above its left shoulder, which shows edges and hollows.
  light() {
    this.renderer.setAutomaticLightCreation(false);
    for (const [position, intensity] of [[[0, 0, 1], 0.55], [[-0.9, 1.4, 0.8], 0.32]]) {
      const light = vtk.Rendering.Core.vtkLight.newInstance({ position, focalPoint: [0, 0, 0], intensity });
      light.setLightTypeToCameraLight();
      this.renderer.addLight(light);
    }
  }
  polygons() {
    const data = vtk.Common.DataModel.vtkPolyData.newInstance(), mapper = vtk.Rendering.Core.vtkMapper.newInstance(),
      actor = vtk.Rendering.Core.vtkActor.newInstance();
    mapper.setInputData(data);
    actor.setMapper(mapper);
    this.renderer.addActor(actor);
    return { data, mapper, actor };
  }
  showParticles(head, { positions, values, axes }, table, slits) {
    const radius = 0.5 * head.spacing * head.growth, shape = head.flat ? "square" : head.domains ? "cube" : "ball";
    if (this.shape !== shape) {
      this.shape = shape;
      this.particles.setShape({ square, cube, ball }[shape]());
    }
    let half = axes;
    if (!head.domains) {
      half = new Float32Array(3 * positions.length);
      for (let i = 0; i < half.length; i += 9) half[i] = half[i + 4] = half[i + 8] = radius;
    } else if (head.flat) {  // a thickness, so that the matrices are regular
      half = Float32Array.from(axes);
      for (let i = 0; i < half.length; i += 9) half[i + 8] = radius;
    }
    this.domains = { head, positions, half, values, table, behind: slits && head.flat && head.domains };
    this.drawParticles(Infinity);
  }
  // Draws at most so many of the particles, the fewer the larger; returns how many.
  drawParticles(most) {
    const { head, behind, table, ...all } = this.domains, bounds = this.bounds(head);
    const thinned = 3 * most < all.positions.length, { positions, half, values } = thinned ? this.fewer(all, most) : all;
    this.particles.show({ positions, axes: half, values, bounds, table });
    // Behind domains in the plane, larger ones close the slits where the deformation varies.
    this.behind.actor.setPosition(0, 0, -0.2 * this.lift(head));
    this.behind.show(behind && !thinned ? { positions, axes: half.map(x => 1.12 * x), values, bounds, table } : { positions: new Float32Array(0), axes: half, bounds });
    return positions.length / 3;
  }
  fewer({ positions, half, values }, most) {
    const { head } = this.domains, { chosen, growth } = thinned(positions, most, head.spacing * head.growth);
    const of = (numbers, n, factor) => numbers && Float32Array.from({ length: n * chosen.length }, (_, k) => factor * numbers[n * chosen[Math.floor(k / n)] + k % n]);
    return { positions: of(positions, 3, 1), half: of(half, 9, growth), values: of(values, 1, 1) };
  }
  showBlocks(head, parts, table) {
    const { data, mapper, actor } = this.blocks;
    data.getPoints().setData(parts.block_corners, 3);
    data.getPolys().setData(parts.block_cells);
    data.getCellData().setScalars(vtk.Common.Core.vtkDataArray.newInstance({ name: "shade", values: parts.block_values }));
    mapper.setLookupTable(table);
    mapper.setColorModeToMapScalars();
    mapper.setUseLookupTableScalarRange(true);
    mapper.setScalarModeToUseCellData();
    actor.setVisibility(parts.block_values.length > 0);
    data.modified();
  }
  showBroken(how, corners, cells, head) {
    const { data, actor } = this[how], lines = [];
    for (let at = 0; at < cells.length; at += cells[at] + 1) {  // a face as the line around it
      const corner = [...cells.subarray(at + 1, at + 1 + cells[at])];
      if (corner.length > 2) corner.push(corner[0]);
      lines.push(corner.length, ...corner);
    }
    data.getPoints().setData(corners, 3);
    data.getLines().setData(Uint32Array.from(lines));
    actor.setPosition(0, 0, head.flat ? this.lift(head) : 0);
    actor.setVisibility(lines.length > 0);
    data.modified();
  }
  // Arrows whose longest, at length 1, is a twelfth of the bodies.
  showArrows(head, { arrow_places: places, arrow_vectors: vectors }, length) {
    if (this.flatArrows !== head.flat) this.arrows.setShape(arrow(this.flatArrows = head.flat));
    const scale = length * this.size(head) / 12 / (head.arrow_largest || 1), axes = new Float32Array(3 * places.length);
    const positions = Float32Array.from(places);
    for (let i = 0; i < places.length; i += 3) {
      const v = [0, 1, 2].map(d => scale * vectors[i + d]), size = Math.hypot(...v);
      const other = head.flat || Math.abs(v[2]) < 0.9 * size ? [0, 0, 1] : [1, 0, 0];
      const side = [other[1] * v[2] - other[2] * v[1], other[2] * v[0] - other[0] * v[2], other[0] * v[1] - other[1] * v[0]];
      const wide = size / (Math.hypot(...side) || 1);
      for (let d = 0; d < 3; ++d) { axes[3 * i + d] = v[d]; axes[3 * i + 3 + d] = wide * side[d]; }
      const [a, b] = [v, side.map(s => wide * s)];
      [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]].forEach((x, d) => { axes[3 * i + 6 + d] = x / (size || 1); });
      if (head.flat) positions[i + 2] += 1.5 * this.lift(head);
    }
    this.arrows.show({ positions, axes, bounds: this.bounds(head) });
    this.arrowScale = scale;
  }
  // Half as many pixels along each side and no faces from behind, or as many pixels as the window has.
  setCoarse(coarse) {
    this.particles.actor.getProperty().setBackfaceCulling(coarse && !this.flat);
    const view = this.window.getApiSpecificRenderWindow(), [wide, high] = view.getSize();
    if (coarse) view.setSize(Math.ceil(wide / 2), Math.ceil(high / 2));
    else this.window.resize();
  }
  // A small ball at a place, or none.
  mark(place, head) {
    if (!this.marker) {
      this.marker = new Glyphs(this.renderer, ball());
      this.marker.actor.setPickable(false);
      this.marker.actor.getProperty().set({ color: [0.9, 0.1, 0.45], lighting: false });
    }
    const positions = Float32Array.from(place || []), r = place ? Math.max(0.35 * head.spacing, 0.004 * this.size(head)) : 0;
    this.marker.show({ positions, axes: Float32Array.from(place ? [r, 0, 0, 0, r, 0, 0, 0, r] : []), bounds: this.bounds(head || { box: [[0, 0, 0], [1, 1, 1]] }) });
    this.render();
  }
  size({ box: [low, high] }) { return Math.hypot(...[0, 1, 2].map(d => high[d] - low[d])); }
  lift(head) { return 0.005 * this.size(head); }
  bounds({ box: [low, high] }) { return [low[0], high[0], low[1], high[1], low[2], high[2]]; }

  show({ head, parts }, range, box, settings, lengthUnit) {
    settings.category = isCategory(head);
    const table = lookupTable(head, range, settings), moved = this.flat !== head.flat;
    this.flat = head.flat;
    this.showParticles(head, parts, table, settings.slits);
    this.showBlocks(head, parts, table);
    for (const how of ["torn", "sheared", "crack"]) this.showBroken(how, parts[how + "_corners"], parts[how + "_cells"], head);
    if (this.layers.has("cracks")) this.crack.actor.setVisibility(false);  // they are a layer
    this.showArrows(head, parts, settings.arrowLength);
    for (const { actor } of [this.particles, this.blocks, this.arrows]) actor.getProperty().setLighting(!head.flat);
    const light = head.flat ? { ambient: 0, diffuse: 1, specular: 0 } : { ambient: 0.34, diffuse: 0.76, specular: 0.06, specularPower: 20 };
    for (const { actor } of [this.particles, this.blocks]) actor.getProperty().set(light);
    this.particles.actor.getProperty().set({ edgeVisibility: settings.outlines, edgeColor: [0.2, 0.2, 0.2] });
    this.layers.place(head.flat ? this.lift(head) : 0);
    const before = String(this.around);
    this.around = this.layers.around(this.bounds({ box }));
    if (this.untouched && before !== String(this.around)) this.aim();
    this.furniture.show(head, table, settings, lengthUnit, this.around);
    if (moved) this.setStyle();
    if (this.fresh) { this.turn(head.flat ? cameras.plane["x, y"] : cameras.space.iso); this.fresh = false; }
    this.renderer.resetCameraClippingRange();
    this.motion.drawn(head.count, this.render());
  }
  setStyle() {
    const style = vtk.Interaction.Style.vtkInteractorStyleManipulator.newInstance(), { mouse, gesture } = manipulators(this.flat);
    for (const one of mouse) style.addMouseManipulator(one);
    style.addGestureManipulator(gesture);
    this.window.getInteractor().setInteractorStyle(style);
    this.renderer.getActiveCamera().setParallelProjection(this.flat);
  }
  turn([from, up]) {
    this.renderer.getActiveCamera().set({ position: from, focalPoint: [0, 0, 0], viewUp: up });
    this.aim();
  }
  look(view) { this.turn(view); this.render(); }
  fit() { if (this.around) { this.aim(); this.render(); } }
  // Moves the camera so that everything is in view.
  aim() {
    const camera = this.renderer.getActiveCamera(), [x0, x1, y0, y1] = this.around, [wide, high] = this.window.getApiSpecificRenderWindow().getSize();
    this.renderer.resetCamera(this.around);
    if (this.flat) {  // with space for the labels and the bar
      const [left, right] = wide > 600 ? [110, 130] : [88, 108], free = [wide - left - right, Math.max(0.4 * high, high - 150)];
      camera.setParallelScale(0.5 * high * Math.max((y1 - y0) / free[1], (x1 - x0) / free[0]));
      this.moveRight(0.5 * (right - left) * 2 * camera.getParallelScale() / high);
    } else {
      camera.dolly(Math.min(0.92, 1.12 - 130 / wide));
      this.moveRight(40 * 2 * camera.getDistance() * Math.tan(camera.getViewAngle() * Math.PI / 360) / high);
    }
    this.untouched = true;
    this.renderer.resetCameraClippingRange();
  }
  // Moves the camera to its right, and the bodies to the left, away from the colour bar.
  moveRight(length) {
    const camera = this.renderer.getActiveCamera(), d = camera.getDirectionOfProjection(), u = camera.getViewUp();
    const right = [d[1] * u[2] - d[2] * u[1], d[2] * u[0] - d[0] * u[2], d[0] * u[1] - d[1] * u[0]], size = length / (Math.hypot(...right) || 1);
    for (const name of ["FocalPoint", "Position"]) camera["set" + name](...camera["get" + name]().map((x, k) => x + size * right[k]));
  }
  // Draws, and returns how long it took in milliseconds: reading a pixel waits for the graphics.
  render() {
    const gl = this.window.getApiSpecificRenderWindow().getContext(), begin = performance.now();
    this.window.getRenderWindow().render();
    gl.readPixels(0, 0, 1, 1, gl.RGBA, gl.UNSIGNED_BYTE, new Uint8Array(4));
    return performance.now() - begin;
  }
  canvas() { this.render(); return this.window.getApiSpecificRenderWindow().getCanvas(); }
}
