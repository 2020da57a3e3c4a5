// SPDX-License-Identifier: MIT
// Charts of histories and energies with uPlot; without it, those that the program draws.

import { ask } from "./server.js";
import { $, element, short, withUnit } from "./text.js";
import { colourOf, css } from "./colours.js";

export const hasCharts = () => typeof uPlot !== "undefined";

// Curves { name, values, shown } over common times. Dragging zooms, a double click shows all, the legend hides curves.
export class Chart {
  constructor(parent, title, timeName, times, curves) {
    this.parent = parent;
    this.time = null;
    const values = (_, ticks) => ticks.map(short), font = "12px system-ui, sans-serif", grid = { stroke: "#e8ebed" };
    this.plot = new uPlot({
      title, width: Math.max(200, parent.clientWidth), height: 250,
      scales: { x: { time: false } }, cursor: { sync: { key: "times" }, drag: { x: true, y: true, uni: 30 } },
      axes: [{ label: timeName, labelFont: font, font, grid, values, labelSize: 22, size: 36 }, { font, grid, values, size: 70 }],
      series: [{ label: "time", value: (_, v) => v === undefined || v === null ? "-" : short(v) },
        ...curves.map(({ name, shown = true }, k) => ({
          label: name, show: shown, stroke: css(colourOf(k + 1)), width: 1.6, points: { show: false }, spanGaps: false,
          value: (_, v) => v === undefined || v === null ? "-" : short(v)
        }))],
      hooks: { draw: [plot => this.drawTime(plot)] }
    }, [times, ...curves.map(c => c.values)], parent);
    new ResizeObserver(() => {
      const width = Math.max(200, parent.clientWidth);
      if (width !== this.plot.width) this.plot.setSize({ width, height: 250 });
    }).observe(parent);
  }
  setData(times, curves) {
    const { min, max } = this.plot.scales.x, whole = min === this.plot.data[0][0] && max === this.plot.data[0].at(-1);
    this.plot.setData([times, ...curves.map(c => c.values)], whole);
    if (!whole) this.plot.redraw();
  }
  // The line at the time of the picture.
  setTime(time) {
    if (this.time === time) return;
    this.time = time;
    this.plot.redraw(false);
  }
  drawTime(plot) {
    if (this.time === null) return;
    const x = plot.valToPos(this.time, "x", true), { left, top, width, height } = plot.bbox, pen = plot.ctx;
    if (!(x >= left && x <= left + width)) return;
    pen.save();
    pen.strokeStyle = "#00796b";
    pen.setLineDash([5, 4]);
    pen.beginPath();
    pen.moveTo(x, top);
    pen.lineTo(x, top + height);
    pen.stroke();
    pen.restore();
  }
}

const isZero = values => values.every(v => v === 0 || v === null);

// Columns of one quantity, `velx:left` and `velx:right`, in one chart.
function historyCharts({ times, columns }) {
  const groups = new Map();
  for (const { name, unit, values } of columns) {
    const [quantity, ...of] = name.split(":"), title = withUnit(quantity, unit);
    if (!groups.has(title)) groups.set(title, []);
    groups.get(title).push({ name: of.join(":") || quantity, values });
  }
  return [...groups].map(([title, curves]) => ({ title, times, curves }));
}

function energyCharts({ times, columns }) {
  const of = (title, choose) => {
    const found = columns.filter(c => choose(c.name) && !isZero(c.values));
    return found.length ? [{ title: withUnit(title, found[0].unit), times, curves: found }] : [];
  };
  const momentum = name => /^(momentum|impulse)/.test(name);
  return [...of("energies", name => name !== "residual" && !momentum(name)), ...of("residual of the energy balance", name => name === "residual"),
    ...of("momentum", name => name.startsWith("momentum"))];
}

export class Charts {
  constructor() { this.charts = []; }
  async refresh() {
    if (!hasCharts()) {
      const answer = await fetch("charts");
      if (answer.ok) $("charts").innerHTML = await answer.text();
      return;
    }
    const { time_unit: unit, history, energy } = await ask("tables");
    const wanted = [["Histories", historyCharts(history)], ["Energy balance", energyCharts(energy)]];
    const key = JSON.stringify(wanted.map(([, list]) => list.map(({ title, curves }) => [title, curves.map(c => c.name)])));
    if (key === this.key) {
      wanted.flatMap(([, list]) => list).forEach(({ times, curves }, k) => this.charts[k].setData(times, curves));
      return;
    }
    this.key = key;
    this.charts = [];
    $("charts").replaceChildren();
    for (const [name, list] of wanted) {
      if (!list.length || list[0].times.length < 2) { if (list.length) this.key = ""; continue; }
      const box = element("div", { className: "charts" });
      $("charts").append(element("h2", { text: name }), box);
      for (const { title, times, curves } of list) {
        const parent = element("div", { className: "chart" });
        box.append(parent);
        this.charts.push(new Chart(parent, title, withUnit("time", unit), times, curves));
      }
    }
  }
  setTime(time) { for (const chart of this.charts) chart.setTime(time); }
}
