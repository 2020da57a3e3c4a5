// SPDX-License-Identifier: MIT
// Parts of a model that are no particles and no blocks: walls, conditions, cracks, joints, and the grid.

import { ask } from "./server.js";
import { $, element } from "./text.js";
import { css } from "./colours.js";

export class Layers {
  constructor(renderer) {
    this.renderer = renderer;
    this.list = [];
  }
  async load(changed) {
    this.list = (await ask("layers")).map(layer => ({ ...layer, actor: this.actorOf(layer) }));
    $("layers-box").hidden = this.list.length === 0;
    $("layers").replaceChildren(...this.list.map(layer => {
      const box = element("input", { type: "checkbox", checked: layer.shown });
      box.onchange = () => { layer.actor.setVisibility(box.checked); changed(); };
      const patch = element("span", { className: "patch" });
      patch.style.background = css(layer.colour);
      return element("label", { className: "line part", title: layer.note || "" }, box, patch, element("span", { text: layer.name }),
        element("span", { className: "quiet", text: layer.note || "" }));
    }));
  }
  actorOf({ points, lines, polygons, colour, opacity, shown, width }) {
    const data = vtk.Common.DataModel.vtkPolyData.newInstance(), mapper = vtk.Rendering.Core.vtkMapper.newInstance(),
      actor = vtk.Rendering.Core.vtkActor.newInstance(), flat = list => Uint32Array.from(list.flatMap(cell => [cell.length, ...cell]));
    data.getPoints().setData(Float32Array.from(points.flat()), 3);
    data.getVerts().setData(flat(lines.length + polygons.length ? [] : points.map((_, k) => [k])));
    data.getLines().setData(flat(lines));
    data.getPolys().setData(flat(polygons));
    mapper.setInputData(data);
    mapper.setScalarVisibility(false);
    actor.setMapper(mapper);
    actor.setPickable(false);
    actor.setVisibility(shown);
    actor.getProperty().set({ color: colour.map(c => c / 255), opacity, lighting: false, lineWidth: width, pointSize: 6 });
    this.renderer.addActor(actor);
    return actor;
  }
  has(name) { return this.list.some(layer => layer.name === name); }
  place(lift) { for (const { actor } of this.list) actor.setPosition(0, 0, lift); }
  // The bounds of bodies and layers together.
  around(bounds) {
    const out = [...bounds];
    for (const { points } of this.list)
      for (const point of points)
        for (let d = 0; d < 3; ++d) {
          out[2 * d] = Math.min(out[2 * d], point[d]);
          out[2 * d + 1] = Math.max(out[2 * d + 1], point[d]);
        }
    return out;
  }
}
