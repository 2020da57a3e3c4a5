// SPDX-License-Identifier: MIT
// What stands around the bodies: directions, axes with ticks and units, and the colour bar.

import { short, ticks, withUnit } from "./text.js";

const font = { fontColor: "#20282d", fontStyle: "normal", fontFamily: "system-ui, sans-serif" };

// The ends of the twelve edges of a box, as corners whose bits are the high ends of x, y and z; in the order of vtk.js.
const edgeEnds = [[0, 1], [1, 3], [2, 3], [0, 2], [4, 5], [5, 7], [6, 7], [4, 6], [0, 4], [1, 5], [3, 7], [2, 6]];
const axisOf = ([a, b]) => Math.log2(a ^ b);

// Of the outer edges, the one at which each axis is labelled: at the low end of the axis that points up, if there is one.
function labelled(edges, up, flat) {
  const out = new Array(12).fill(0);
  for (let axis = 0; axis < 3; ++axis) {
    const outer = edgeEnds.map((_, e) => e).filter(e => edges[e] === 1 && axisOf(edgeEnds[e]) === axis);
    const low = end => edgeEnds[end][0] & (1 << (flat ? 1 - axis : up)) ? 1 : 0;
    outer.sort((a, b) => low(a) - low(b));
    if (outer.length) out[outer[0]] = 1;
  }
  return out;
}

// vtk.js labels all outer edges; here each axis is labelled once.
const cubeAxes = typeof vtk !== "undefined" ? vtk.macro.newInstance((api, model, values) => {
  vtk.Rendering.Core.vtkCubeAxesActor.extend(api, model, values);
  const before = api.updateTextData;
  api.updateTextData = (faces, edges, places, texts) => {
    model.textValues.length = 0;
    const up = model.camera.getViewUp().map(Math.abs), flat = model.dataBounds[4] === model.dataBounds[5];
    before(faces, labelled(edges, up.indexOf(Math.max(...up)), flat), places, texts);
  };
}, "TriboAxes") : null;

export class Furniture {
  constructor(renderer, interactor) {
    this.renderer = renderer;
    const { vtkAxesActor, vtkScalarBarActor } = vtk.Rendering.Core;
    const colours = [[206, 62, 53], [58, 145, 74], [45, 98, 190]];
    const directions = vtkAxesActor.newInstance({
      xConfig: { color: colours[0] }, yConfig: { color: colours[1] }, zConfig: { color: colours[2] },
      config: { recenter: false, tipResolution: 24, tipRadius: 0.11, tipLength: 0.28, shaftResolution: 16, shaftRadius: 0.035 }
    });
    this.triad = vtk.Interaction.Widgets.vtkOrientationMarkerWidget.newInstance({
      actor: directions, interactor, viewportCorner: vtk.Interaction.Widgets.vtkOrientationMarkerWidget.Corners?.BOTTOM_LEFT ?? "BOTTOM_LEFT",
      viewportSize: 0.13, minPixelSize: 64, maxPixelSize: 110
    });
    this.triad.setEnabled(true);
    this.axes = cubeAxes({
      camera: renderer.getActiveCamera(), boundsScaleFactor: 1.04, axisTitlePixelOffset: 34, tickLabelPixelOffset: 10, gridLines: false,
      axisTextStyle: { ...font, fontSize: 14 }, tickTextStyle: { ...font, fontSize: 12 },
      generateTicks: bounds => {
        const sizes = [0, 1, 2].map(d => bounds[2 * d + 1] - bounds[2 * d]), longest = Math.max(...sizes);
        const places = sizes.map((size, d) => ticks(bounds[2 * d], bounds[2 * d + 1], size > 0.4 * longest ? 5 : size > 0.15 * longest ? 3 : 2));
        return { ticks: places, tickStrings: places.map(list => list.map(short)) };
      }
    });
    this.axes.getProperty().setColor(0.45, 0.5, 0.53);
    this.bar = vtkScalarBarActor.newInstance({ axisTextStyle: { ...font, fontSize: 13 }, tickTextStyle: { ...font, fontSize: 12 } });
    this.bar.setDrawNanAnnotation(false);
    this.bar.setDrawBelowRangeSwatch(false);
    this.bar.setDrawAboveRangeSwatch(false);
    this.bar.setAutoLayout(helper => this.layOut(helper));
    this.bar.setGenerateTicks(helper => {
      const places = ticks(...helper.getLastTickBounds(), 5);
      helper.setTicks(places);
      helper.setTickStrings(places.map(short));
    });
    renderer.addActor(this.axes);
    renderer.addActor(this.bar);
  }
  // The bar upright at the right edge, its title above it.
  layOut(helper) {
    const [width, height] = helper.getLastSize(), box = helper.getBoxSizeByReference();
    Object.assign(helper.getAxisTextStyle(), this.bar.getAxisTextStyle());
    Object.assign(helper.getTickTextStyle(), this.bar.getTickTextStyle());
    const sizes = helper.updateTextureAtlas(), pixels = Math.max(sizes.titleWidth, sizes.tickWidth + 22);
    helper.setTopTitle(true);
    helper.setTickLabelPixelOffset(5);
    helper.setAxisTitlePixelOffset(9);
    box[0] = 2 * (sizes.tickWidth + 5 + 16) / width;
    box[1] = Math.min(2 * 300 / height, 1.2);
    helper.setBoxPosition([1 - box[0] - 2 * Math.max(14, 14 + 0.5 * (pixels - sizes.tickWidth - 21)) / width, -0.5 * box[1]]);
    helper.recomputeBarSegments(sizes);
  }
  show(head, table, settings, lengthUnit, bounds) {
    this.triad.setEnabled(settings.triad);
    this.axes.setVisibility(settings.axes);
    this.axes.setDataBounds(bounds);
    this.axes.setAxisLabels(["x", "y", "z"].map(name => withUnit(name, lengthUnit)));
    this.axes.setFaceVisibilityAngle(head.flat ? 0 : 8);
    this.bar.setVisibility(settings.bar && !settings.category);
    if (!settings.category) {
      this.bar.setScalarsToColors(table);
      this.bar.setAxisLabel(withUnit(head.field, head.unit));
    }
  }
}
