// SPDX-License-Identifier: MIT
// The particle, block or contact that was clicked on: its values, and a chart of them over the run.

import { ask } from "./server.js";
import { $, element, short, withUnit } from "./text.js";
import { Chart } from "./charts.js";

// What lies under a point of the canvas, nearest first around it: { particle } an index, or { block, point }.
async function under(scene, x, y, head, parts) {
  const selector = scene.window.getApiSpecificRenderWindow().getSelector();
  selector.setFieldAssociation(vtk.Common.DataModel.vtkDataSet.FieldAssociations.FIELD_ASSOCIATION_CELLS);
  selector.setCaptureZValues(true);
  const source = await selector.getSourceDataAsync(scene.renderer, x, y, x, y);
  const found = source ? source.generateSelection(x, y, x, y) : [];
  scene.render();
  for (const node of found) {
    const { prop, compositeID, attributeID, worldPosition } = node.getProperties();
    if (prop === scene.particles.actor) {
      const copy = scene.particles.copyOf({ compositeID, attributeID });
      if (copy < head.count) return { particle: parts.indices[copy] };
    }
    if (prop === scene.blocks.actor) return { block: parts.block_names[attributeID], point: worldPosition || [0, 0, 0] };
  }
  return null;
}

export class Picking {
  // `current` returns the present scene, frame and legend.
  constructor(current) {
    this.current = current;
    this.picked = [];
    this.token = 0;
    let down = null;
    $("view").addEventListener("pointerdown", e => { down = [e.clientX, e.clientY]; });
    $("view").addEventListener("pointerup", e => {
      if (down && Math.hypot(e.clientX - down[0], e.clientY - down[1]) < 4 && e.button === 0) this.pick(e.clientX, e.clientY);
      down = null;
    });
  }
  async pick(clientX, clientY) {
    const { scene, frame, k } = this.current();
    if (!scene || !frame) return;
    scene.motion.rest();
    const box = scene.canvas().getBoundingClientRect(), size = scene.window.getApiSpecificRenderWindow().getSize();
    const x = Math.round((clientX - box.left) / box.width * size[0]), y = Math.round((box.bottom - clientY) / box.height * size[1]);
    const hit = await under(scene, x, y, frame.head, frame.parts);
    if (!hit) return this.forget();
    try {
      const answer = await ask(hit.particle !== undefined ? `particle/${k}/${hit.particle}`
        : `block/${k}/${hit.block}?` + new URLSearchParams({ x: hit.point[0], y: hit.point[1], z: hit.point[2] }));
      this.picked = [answer.picked, answer.contact].filter(Boolean);
      this.draw();
      this.mark();
    } catch (error) {
      $("picked").replaceChildren(element("p", { className: "bad", text: error.message }));
    }
  }
  forget() {
    this.picked = [];
    this.chosen = null;
    this.token++;
    $("picked").replaceChildren(element("p", { className: "quiet", text: "Click on a particle or a block to see its values." }));
    this.mark();
  }
  // The values at another time.
  async follow(k) {
    if (!this.picked.length) return;
    const token = ++this.token, { frame } = this.current();
    const [first] = this.picked;
    const at = await ask(`values/${k}?` + query(first)).catch(() => null);
    const other = this.picked[1] && await ask(`values/${k}?` + query(this.picked[1])).catch(() => null);
    if (token !== this.token || !frame) return;
    this.picked = [at || { ...first, gone: true }, other].filter(Boolean);
    this.draw();
    this.mark();
  }
  draw() {
    const { legend } = this.current(), old = $("picked").querySelector("#history");
    $("picked").replaceChildren(...this.picked.flatMap(one => this.table(one, legend)));
    if (old) $("picked").append(old);
  }
  table(one, legend) {
    const name = one.kind === "contact" ? `Contact of the blocks ${one.numbers[0]} and ${one.numbers[1]}`
      : `${one.kind[0].toUpperCase()}${one.kind.slice(1)} ${one.numbers[0]}`;
    if (one.gone) return [element("h2", { text: name }), element("p", { className: "quiet", text: "It is not there at this time." })];
    const rows = [...one.place.map((x, d) => ({ name: `position.${"xyz"[d]}`, unit: legend.length, value: x })),
      ...one.fields.flatMap(f => f.values.map((value, d) => ({ name: f.components.length ? `${f.name}.${f.components[d]}` : f.name, unit: f.unit, value })))];
    const body = rows.map(row => {
      const line = element("tr", { className: "link", title: "chart over the run" }, element("td", { text: row.name }),
        element("td", { className: "number", text: short(row.value) }), element("td", { className: "quiet", text: row.unit || "" }));
      if (this.chosen === one.kind + row.name) line.classList.add("chosen");
      line.onclick = () => this.history(one, row);
      return line;
    });
    return [element("h2", { text: name + (one.material ? `, ${one.material}` : "") }), element("table", {}, ...body)];
  }
  // A chart of a value over the run, and of the other components of its field.
  async history(one, row) {
    this.chosen = one.kind + row.name;
    this.draw();
    let box = $("picked").querySelector("#history");
    if (!box) { box = element("div", { id: "history" }); $("picked").prepend(box); }
    box.textContent = "reading the files of the run";
    try {
      const { times, time_unit: unit, files, fields } = await ask("history?" + query(one));
      box.replaceChildren();
      const stem = row.name.split(".")[0], curves = Object.keys(fields).filter(name => name === row.name || (name.split(".")[0] === stem && stem !== name))
        .map(name => ({ name, values: fields[name].values, shown: name === row.name }));
      this.chart = new Chart(box, withUnit(stem, row.unit), withUnit("time", unit), times, curves);
      this.chart.setTime(this.current().frame.head.time);
      if (times.length < files) box.append(element("p", { className: "quiet", text: `${times.length} of ${files} files` }));
    } catch (error) {
      box.textContent = error.message;
    }
  }
  // A ring around what was picked.
  mark() {
    const { scene, frame } = this.current();
    if (!scene) return;
    const [one] = this.picked;
    scene.mark(one && !one.gone ? one.place : null, frame.head);
    this.chart?.setTime(frame.head.time);
  }
}

const query = ({ kind, numbers }) => new URLSearchParams({ kind, number: numbers[0], other: numbers[1] });
