// SPDX-License-Identifier: MIT
// Pictures (PNG) and films (WebM) of what is shown, with the text that lies over it.

import { $ } from "./text.js";

function save(blob, name) {
  const link = document.createElement("a");
  link.href = URL.createObjectURL(blob);
  link.download = name;
  link.click();
  setTimeout(() => URL.revokeObjectURL(link.href), 60000);
}

// The drawing, the time and the legend on one canvas.
function compose(scene, legend, onto = document.createElement("canvas")) {
  const drawing = scene.canvas(), ratio = drawing.width / drawing.clientWidth || 1, pen = onto.getContext("2d");
  if (onto.width !== drawing.width || onto.height !== drawing.height) [onto.width, onto.height] = [drawing.width, drawing.height];
  pen.fillStyle = "white";
  pen.fillRect(0, 0, onto.width, onto.height);
  pen.drawImage(drawing, 0, 0);
  pen.save();
  pen.scale(ratio, ratio);
  pen.fillStyle = "#20282d";
  pen.font = "600 15px system-ui, sans-serif";
  pen.fillText($("time").textContent, 14, 26);
  pen.font = "13px system-ui, sans-serif";
  pen.textAlign = "right";
  legend.forEach(({ name, colour }, k) => {
    const y = 62 + 18 * k, x = onto.width / ratio - 16;
    pen.fillStyle = colour;
    pen.fillRect(x - 12, y - 10, 12, 12);
    pen.fillStyle = "#20282d";
    pen.fillText(name, x - 18, y);
  });
  pen.restore();
  return onto;
}

export async function savePicture(scene, legend, name) {
  const blob = await new Promise(done => compose(scene, legend).toBlob(done, "image/png"));
  save(blob, name + ".png");
}

const kinds = ["video/webm;codecs=vp9", "video/webm;codecs=vp8", "video/webm"];

// Shows all times one after the other and records them. `show` draws a time; returns early when `stopped()`.
export async function saveFilm({ scene, legend, count, rate, show, stopped, name }) {
  const kind = kinds.find(k => window.MediaRecorder?.isTypeSupported(k));
  if (!kind) throw new Error("this browser records no films");
  await show(0);
  const canvas = compose(scene, legend()), stream = canvas.captureStream(0), [track] = stream.getVideoTracks();
  const recorder = new MediaRecorder(stream, { mimeType: kind, videoBitsPerSecond: 8e6 }), pieces = [];
  recorder.ondataavailable = event => { if (event.data.size) pieces.push(event.data); };
  const ended = new Promise(done => { recorder.onstop = done; });
  const begun = new Promise(done => { recorder.onstart = done; }), wait = time => new Promise(done => setTimeout(done, Math.max(0, time)));
  recorder.start();
  await begun;
  for (let k = 0; k < count && !stopped(); ++k) {
    const begin = performance.now();
    await show(k);
    compose(scene, legend(), canvas);
    track.requestFrame();
    await wait(1000 / rate - (performance.now() - begin));
  }
  await wait(300);  // so that the last picture is in the film
  track.requestFrame();
  await wait(300);
  recorder.stop();
  await ended;
  save(new Blob(pieces, { type: "video/webm" }), name + ".webm");
}
