// SPDX-License-Identifier: MIT
// The page: asks the server for the run and its times, and draws what the settings say.

import { ask, frameOf, tell } from "./server.js";
import { $, seconds, short, element } from "./text.js";
import { Scene, cameras } from "./scene.js";
import { Panel } from "./panel.js";
import { Player } from "./player.js";
import { Picking } from "./picking.js";
import { Charts } from "./charts.js";
import { bindKeys } from "./keys.js";
import { savePicture, saveFilm } from "./capture.js";

const settings = {
  field: "", map: "viridis", reversed: false, rangeMode: "all", own: [0, 1], arrows: "", arrowLength: 1, hidden: new Set(), bodies: new Set(), groups: new Set(),
  sections: {}, axes: true, triad: true, bar: true, slits: true, outlines: false, most: 250000
};
const ranges = new Map(), mostPlaying = [60000, 20000, 6000], mostFirst = 30000, mostStill = 1500000;
let state = {}, scene = null, webgl = typeof vtk !== "undefined", frame = null, shown = -1, filming = false, still = 0, working = null, next = null;

const legendOf = () => ({ materials: state.materials || [], bodies: (state.bodies || []).map(b => b.name), groups: state.block_groups || [], length: state.model?.["unit of length"] || "", time: state.model?.["unit of time"] || "" });
const modelView = () => state.status === "model";

function query(most) {
  const out = new URLSearchParams({ most: Math.floor(most) });
  if (settings.field) out.set("field", settings.field);
  if (settings.arrows) out.set("arrows", settings.arrows);
  if (settings.hidden.size) out.set("hidden", [...settings.hidden].join());
  if (settings.bodies.size) out.set("bodies", [...settings.bodies].join());
  if (settings.groups.size) out.set("groups", [...settings.groups].join());
  const sections = Object.entries(settings.sections).filter(([, s]) => s.on).map(([axis, s]) => axis + (s.above ? "<" : ">") + s.place);
  if (sections.length) out.set("sections", sections.join());
  return out.toString();
}

// The range of a field and the box of the bodies over the times; those of this time until they are known.
async function overTimes(head) {
  const files = state.times.length, kept = ranges.get(head.field);
  if (!kept || (kept.files !== files && performance.now() - kept.at > 10000)) {
    let late = false;
    const mine = { range: kept?.range || head.range, box: kept?.box || head.box, files, at: performance.now() };
    ranges.set(head.field, mine);
    const asked = ask("range?field=" + encodeURIComponent(head.field)).then(found => { Object.assign(mine, found); if (late) redraw(); });
    await Promise.race([asked, new Promise(done => setTimeout(done, 700))]);
    late = true;
  }
  return ranges.get(head.field);
}

const joined = ([low, high], [l, h]) => [low.map((x, d) => Math.min(x, l[d])), high.map((x, d) => Math.max(x, h[d]))];

function drawPicture(k) {
  let picture = $("view").querySelector("img");
  if (!picture) { picture = new Image(); picture.alt = "particles and blocks"; $("view").append(picture); }
  picture.src = `picture/${k}?` + new URLSearchParams({ field: settings.field });
}

function tellThinning({ count, total, visible, inside }) {
  const drawn = [];
  if (inside) drawn.push(`${inside.toLocaleString("en")} inside are not drawn`);
  if (count < visible - inside) drawn.push(`thinned: ${count.toLocaleString("en")} of ${(visible - inside).toLocaleString("en")} are drawn, larger`);
  $("note").textContent = total ? [`${total.toLocaleString("en")} particles`, ...drawn].join("; ") : "";
}

// A model before its run is drawn in the colours of its bodies.
async function startWithBodies(k) {
  const { fields } = (await frameOf(k, query(1), "")).head;
  settings.field = ["body", "material", "group"].find(name => fields.includes(name)) || "";
}

async function draw(k, most) {
  const started = state.started || "";
  if (modelView() && !settings.field) await startWithBodies(k);
  frame = await frameOf(k, query(most), started);
  const { head } = frame, all = await overTimes(head), legend = legendOf();
  const range = settings.rangeMode === "own" ? settings.own : head.integers || settings.rangeMode === "frame" ? head.range : all.range;
  const box = joined(head.box, all.box);
  if (webgl && !scene) {
    try {
      scene = new Scene($("view"));
      await scene.layers.load(redraw);
      showCameras(head.flat);
    } catch (error) { webgl = false; console.warn("no WebGL: " + error); }
  }
  if (!settings.field) settings.field = head.field;
  if (scene) scene.show(frame, range, box, settings, legend.length);
  else drawPicture(k);
  panel.show(head, range, legend);
  tellThinning(head);
  $("time").textContent = modelView() ? "before the run" : `time ${short(head.time)} ${legend.time}`;
  charts.setTime(head.time);
  if (k !== shown) picking.follow(k);
  shown = k;
  document.body.dataset.shown = String(k);
  document.body.dataset.drawn = String(head.count);
}

// How many particles the computer draws in a seventh of a second.
const playable = () => mostPlaying.find(n => !scene || n < scene.motion.within(150)) || mostPlaying.at(-1);
// How many are drawn at first, before the picture is still: what the computer draws in half a second.
const atFirst = () => Math.max(mostFirst, scene ? scene.motion.within(500) : 0);

// Draws a time. While one is drawn, only the last request waits.
async function show(k) {
  if (working) { next = k; return working; }
  working = (async () => {
    for (next = k; next !== null;) {
      const now = next;
      next = null;
      try { await draw(now, Math.min(settings.most, filming ? mostPlaying[0] : player.playing ? playable() : atFirst())); }
      catch (error) { $("note").textContent = error.message; console.warn(error); }
    }
  })();
  await working;
  working = null;
  clearTimeout(still);
  if (!player.playing && !filming) still = setTimeout(showMore, 600);
}
const redraw = () => { if (player.count) show(player.at); };

// Once the picture is still, all particles if they are drawn within a second, or as many as are drawn within four.
async function showMore() {
  const { head } = frame || {};
  if (working || !head) return;
  const { motion } = scene || {}, all = head.visible - head.inside, fast = all <= Math.min(mostStill, motion ? motion.within(1000) : mostStill);
  const most = settings.most < 250000 ? settings.most : fast ? mostStill : Math.min(settings.most, Math.max(2 * mostFirst, motion?.within(4000) ?? 0));
  if (head.count >= Math.min(all, 0.7 * most)) return;
  await draw(shown, most).catch(error => { $("note").textContent = error.message; });
}

const panel = new Panel(settings, redraw), player = new Player(show), charts = new Charts(),
  picking = new Picking(() => ({ scene, frame, k: shown, legend: legendOf() }));

function showCameras(flat) {
  if (flat) return;
  $("cameras").replaceChildren(...Object.entries(cameras.space).map(([name, view]) => {
    const button = element("button", { text: name, title: "look at " + name });
    button.onclick = () => scene.look(view);
    return button;
  }));
}

function showState() {
  const model = state.model || {}, running = state.status === "running", unit = model["unit of time"] || "";
  $("title").textContent = document.title = (model.title || (modelView() ? (state.input || "").split("/").pop() : state.folder) || "Tribo").split("\n")[0];
  $("title").title = (model.title || "").trim();
  $("status").textContent = modelView() ? "model before its run" : state.status + (state.reason ? ": " + state.reason : "");
  $("status").className = state.status === "failed" || state.status === "lost" ? "bad" : "quiet";
  document.body.classList.toggle("model", modelView());
  $("film").hidden = $("of-run").hidden = document.querySelector("footer").hidden = modelView();
  $("progress").value = state.end_time > 0 ? state.time / state.end_time : 0;
  if (!modelView())
    $("where").textContent = `time ${short(state.time)} of ${short(state.end_time)} ${unit}, step ${state.step}` +
      (running && state.seconds_left > 0 ? `, ${seconds(state.seconds_left)} left` : "");
  $("stop").disabled = $("checkpoint").disabled = !running;
  $("stop").hidden = $("checkpoint").hidden = !running;
  $("follow-label").hidden = !running;
}

async function refresh() {
  const files = state.times?.length, status = state.status;
  state = await ask("state");
  showState();
  if (state.times.length && (state.times.length !== files || state.status !== status)) await player.setCount(state.times.length);
  if (!modelView() && (state.status === "running" || status !== state.status)) await charts.refresh();
}

const turn = (select, by) => {
  select.selectedIndex = (select.selectedIndex + by + select.options.length) % select.options.length;
  select.dispatchEvent(new Event("change"));
};
const flip = box => { box.checked = !box.checked; box.dispatchEvent(new Event("change")); };
const fileName = () => `${settings.field || "tribo"}_${String(shown).padStart(5, "0")}`;
const shot = () => scene && savePicture(scene, panel.legend, fileName());

async function film() {
  if (filming) { filming = false; return; }
  if (!scene || player.count < 2) return;
  player.stop();
  filming = true;
  const [at, button] = [player.at, $("film")];
  player.unfollow();
  button.textContent = "Stop";
  button.classList.add("on");
  try {
    await saveFilm({
      scene, legend: () => panel.legend, count: player.count, rate: Number($("speed").value), name: settings.field || "tribo",
      show: k => player.go(k), stopped: () => !filming
    });
  } catch (error) { $("note").textContent = error.message; }
  filming = false;
  button.textContent = "Film";
  button.classList.remove("on");
  player.go(at);
}

// For tests, which import this module.
export const page = { settings, player, charts, get scene() { return scene; }, get frame() { return frame; }, get filming() { return filming; } };

$("fit").onclick = () => scene?.fit();
$("shot").onclick = shot;
$("film").onclick = film;
const order = (what, done) => async () => { $("told").textContent = (await tell(what)).sent ? done : "the run does not go on"; };
$("stop").onclick = order("stop", "it stops after this step, with a checkpoint");
$("checkpoint").onclick = order("checkpoint", "written after this step");
bindKeys(player, {
  speed: by => { $("speed").selectedIndex = Math.min($("speed").options.length - 1, Math.max(0, $("speed").selectedIndex + by)); },
  fit: () => scene?.fit(), field: by => turn($("field"), by), map: () => turn($("map"), 1), arrows: () => turn($("arrows"), 1),
  range: () => panel.setRangeMode(settings.rangeMode === "all" ? "frame" : "all"), axes: () => flip($("axes")), outlines: () => flip($("outlines")),
  shot, forget: () => picking.forget()
});

(async function loop() {
  try { await refresh(); } catch (error) { $("status").textContent = "no answer: is Tribo still there?"; console.warn(error); }
  setTimeout(loop, state.status === "running" ? 1000 : 5000);
})();
