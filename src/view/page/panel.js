// SPDX-License-Identifier: MIT
// The controls beside the picture.

import { $, element, short, withUnit } from "./text.js";
import { colourOf, css, isCategory, maps } from "./colours.js";

// Fills a list of choices if they have changed, and keeps the choice if it is still there.
export function fill(select, names, chosen) {
  if ([...select.options].map(o => o.value).join("\n") === names.join("\n")) return;
  const before = chosen ?? select.value;
  select.replaceChildren(...names.map(name => new Option(name || "none", name, false, name === before)));
}

export class Panel {
  constructor(settings, changed) {
    this.settings = settings;
    this.changed = changed;
    fill($("map"), Object.keys(maps), settings.map);
    const bind = (id, kind, name, read = input => input.value) => {
      $(id)[kind] = () => { settings[name] = read($(id)); changed(); };
    };
    const checked = input => input.checked;
    bind("field", "onchange", "field");
    bind("map", "onchange", "map");
    bind("reversed", "onchange", "reversed", checked);
    bind("arrows", "onchange", "arrows");
    bind("arrow-length", "oninput", "arrowLength", input => 10 ** Number(input.value));
    for (const id of ["axes", "triad", "bar", "slits", "outlines"]) bind(id, "onchange", id, checked);
    bind("most", "onchange", "most", input => Number(input.value));
    $("range-mode").onchange = () => this.setRangeMode($("range-mode").value);
    for (const id of ["low", "high"]) $(id).onchange = () => this.readRange();
  }
  setRangeMode(mode) {
    $("range-mode").value = this.settings.rangeMode = mode;
    $("own-range").hidden = mode !== "own";
    if (mode === "own" && this.range) {
      this.settings.own = [...this.range];
      [$("low").value, $("high").value] = this.range.map(short);
    }
    this.changed();
  }
  readRange() {
    const [low, high] = [Number($("low").value), Number($("high").value)];
    const valid = Number.isFinite(low) && high > low;
    for (const id of ["low", "high"]) $(id).classList.toggle("bad", !valid);
    if (!valid) return;
    this.settings.own = [low, high];
    this.changed();
  }
  // What a frame offers.
  show(head, range, legend) {
    this.range = range;
    fill($("field"), head.fields, head.field);
    fill($("arrows"), ["", ...head.vectors]);
    this.showParts(head, legend);
    this.showSections(head, legend);
    this.showLegend(head, legend);
    const unit = this.settings.arrows ? ` of ${short(head.arrow_largest)}${head.arrow_unit ? " " + head.arrow_unit : ""} at most` : "";
    const drawn = head.parts.find(p => p.name === "arrow_places").length / 3;
    $("arrow-note").textContent = !this.settings.arrows ? "" : head.arrow_total === 0 ? "There are none at this time."
      : `${head.arrow_total > drawn ? drawn + " of " : ""}${head.arrow_total} arrows${unit}`;
  }
  showParts(head, legend) {
    const key = JSON.stringify([head.materials, head.bodies, head.groups, legend.materials, isCategory(head)]);
    if (this.parts === key) return;
    this.parts = key;
    const line = (number, name, kind, hidden) => {
      const box = element("input", { type: "checkbox", checked: !hidden.has(number) }), patch = element("span", { className: "patch" });
      box.onchange = () => { if (box.checked) hidden.delete(number); else hidden.add(number); this.changed(); };
      patch.style.background = css(colourOf(number));
      const only = element("button", { text: "only", title: "hide all others" });
      only.onclick = event => {
        event.preventDefault();
        const all = { material: head.materials, body: head.bodies.map(b => b.number), group: head.groups }[kind], alone = hidden.size === all.length - 1 && !hidden.has(number);
        hidden.clear();
        if (!alone) all.filter(k => k !== number).forEach(k => hidden.add(k));
        this.parts = "";
        this.changed();
      };
      return element("label", { className: "line part" + (kind === "body" ? " body" : "") }, box, kind === "body" ? "" : patch, element("span", { text: name }), only);
    };
    const { hidden, bodies, groups } = this.settings;
    const of = k => head.bodies.filter(b => b.material === k).map(({ number }) => line(number, legend.bodies[number - 1] || `body ${number}`, "body", bodies));
    $("parts").replaceChildren(
      ...head.materials.flatMap(k => [line(k, legend.materials[k - 1] ?? `material ${k}`, "material", hidden), ...(of(k).length > 1 ? of(k) : [])]),
      ...head.groups.map(k => line(k, legend.groups[k - 1] || `group ${k} of blocks`, "group", groups)));
    $("parts-box").hidden = head.materials.length + head.groups.length === 0;
  }
  showSections(head, legend) {
    const [low, high] = head.box;
    if (this.sections) return;
    this.sections = true;
    for (const [d, axis] of (head.flat ? ["x", "y"] : ["x", "y", "z"]).entries()) {
      const section = this.settings.sections[axis] = { on: false, place: 0.5 * (low[d] + high[d]), above: true };
      const box = element("input", { type: "checkbox", ariaLabel: `section normal to ${axis}` }), turn = element("button", { text: "turn", title: "show the other side" });
      const slide = element("input", { type: "range", min: 0, max: 200, value: 100, ariaLabel: `place of the section normal to ${axis}` }), where = element("span", { className: "quiet" });
      const tell = () => { where.textContent = section.on ? withUnit(`${axis} ${section.above ? "\u2264" : "\u2265"} ${short(Math.abs(section.place) < 1e-4 * (high[d] - low[d]) ? 0 : section.place)}`, legend.length) : ""; };
      box.onchange = () => { section.on = box.checked; tell(); this.changed(); };
      slide.oninput = () => {
        const part = Number(slide.value) / 200;
        section.place = low[d] + part * (high[d] - low[d]);
        section.on = box.checked = true;
        tell();
        this.changed();
      };
      turn.onclick = () => { section.above = !section.above; section.on = box.checked = true; tell(); this.changed(); };
      box.id = `section-${axis}`;
      slide.id = `place-${axis}`;
      $("sections").append(element("div", { className: "section" }, element("label", { className: "line" }, box, axis), slide, turn), where);
    }
  }
  // The names of materials on the picture, where they are the colours.
  showLegend(head, legend) {
    this.legend = [];
    if (isCategory(head)) {
      const { materials, bodies, groups } = legend, { hidden, bodies: hiddenBodies, groups: hiddenGroups } = this.settings;
      const [few, names, without] = { material: [head.materials, materials, hidden], body: [head.bodies.map(b => b.number), bodies, hiddenBodies],
        group: [head.groups, groups, hiddenGroups] }[head.field] || [[], [], new Set()];
      this.legend = few.filter(k => !without.has(k)).map(k => ({ name: names[k - 1] || `${head.field} ${k}`, colour: css(colourOf(k)) }));
    }
    for (const [how, colour] of [["torn", "rgb(214,38,41)"], ["sheared", "rgb(31,89,199)"], ["crack", "rgb(214,51,132)"]])
      if (head.parts.find(p => p.name === how + "_cells").length) this.legend.push({ name: how === "crack" ? "cracks" : `bonds ${how}`, colour });
    $("legend").replaceChildren(...this.legend.slice(0, 30).map(({ name, colour }) => {
      const patch = element("span", { className: "patch" });
      patch.style.background = colour;
      return element("div", {}, name + " ", patch);
    }));
  }
}
