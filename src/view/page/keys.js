// SPDX-License-Identifier: MIT
// The keys, and the list of them.

import { $, element } from "./text.js";

export function bindKeys(player, actions) {
  const keys = [
    [[" ", "k"], "space", "play or pause", () => player.toggle()],
    [["ArrowLeft", ","], "\u2190", "one time back", () => player.step(-1)],
    [["ArrowRight", "."], "\u2192", "one time on", () => player.step(1)],
    [["PageUp"], "Page up", "a tenth back", () => player.jump(player.at - Math.ceil(player.count / 10))],
    [["PageDown"], "Page down", "a tenth on", () => player.jump(player.at + Math.ceil(player.count / 10))],
    [["Home"], "Home", "first time", () => player.jump(0)],
    [["End"], "End", "last time", () => player.jump(player.count - 1)],
    [["+", "="], "+", "faster", () => actions.speed(1)],
    [["-"], "-", "slower", () => actions.speed(-1)],
    [["f"], "f", "fit the picture", actions.fit],
    [["c"], "c", "next field", () => actions.field(1)],
    [["C"], "C", "field before", () => actions.field(-1)],
    [["m"], "m", "next colour map", actions.map],
    [["r"], "r", "range of all times or of each time", actions.range],
    [["a"], "a", "axes", actions.axes],
    [["o"], "o", "outlines of particles", actions.outlines],
    [["v"], "v", "arrows of the next vector", actions.arrows],
    [["s"], "s", "save the picture", actions.shot],
    [["Escape"], "Esc", "forget what was picked", actions.forget],
    [["?", "h"], "?", "this list", () => toggleHelp()]
  ];
  const table = element("table", {}, ...keys.map(([, name, meaning]) => element("tr", {},
    element("td", {}, element("kbd", { text: name })), element("td", { text: meaning }))));
  const mouse = [["left button", "rotate; in the plane move"], ["Shift and left button", "move"], ["wheel", "zoom to the mouse"],
    ["click", "values of a particle or block"], ["drag in a chart", "zoom; double click shows all"]];
  const close = element("button", { text: "Close" });
  close.onclick = () => $("help").close();
  $("help").append(element("h2", { text: "Keys" }), table, element("h2", { text: "Mouse" }),
    element("table", {}, ...mouse.map(([name, meaning]) => element("tr", {}, element("td", { text: name }), element("td", { text: meaning })))), close);
  const toggleHelp = () => { if ($("help").open) $("help").close(); else $("help").showModal(); };
  $("help-button").onclick = toggleHelp;
  document.addEventListener("keydown", event => {
    if (event.ctrlKey || event.altKey || event.metaKey) return;
    const typing = event.target.matches("select, input:not([type=checkbox]):not([type=range])");
    if (typing || (event.key === " " && event.target.matches("button, summary, input"))) return;
    const found = keys.find(([names]) => names.includes(event.key));
    if (!found || ($("help").open && event.key !== "?")) return;
    event.preventDefault();
    found[3]();
  });
}
