// SPDX-License-Identifier: MIT
// Which time is shown: playing, stepping, scrubbing, and following a run that goes on.

import { $ } from "./text.js";

export class Player {
  // `show` draws a frame by its number and returns when it is drawn.
  constructor(show) {
    this.show = show;
    this.count = 0;
    this.at = 0;
    this.playing = false;
    $("frame").oninput = () => { this.stop(); this.unfollow(); this.go(Number($("frame").value)); };
    $("play").onclick = () => this.toggle();
    $("first").onclick = () => this.jump(0);
    $("last").onclick = () => this.jump(this.count - 1);
    $("back").onclick = () => this.step(-1);
    $("forth").onclick = () => this.step(1);
    $("follow").onchange = () => { if ($("follow").checked) { this.stop(); this.go(this.count - 1); } };
  }
  // New files have come.
  setCount(count) {
    this.count = count;
    $("frame").max = Math.max(0, count - 1);
    if ($("follow").checked && !this.playing) return this.go(count - 1);
    this.label();
  }
  label() {
    $("frame").value = this.at;
    $("number").textContent = `${this.at + 1} / ${this.count}`;
  }
  go(k) {
    this.at = Math.min(this.count - 1, Math.max(0, k));
    this.label();
    return this.show(this.at);
  }
  unfollow() { $("follow").checked = false; }
  jump(k) { this.stop(); this.unfollow(); return this.go(k); }
  step(by) { return this.jump(this.at + by); }
  toggle() { if (this.playing) this.stop(); else this.play(); }
  stop() {
    this.playing = false;
    $("play").textContent = "Play";
    $("play").classList.remove("on");
  }
  async play() {
    if (this.playing || this.count < 2) return;
    this.unfollow();
    this.playing = true;
    $("play").textContent = "Pause";
    $("play").classList.add("on");
    if (this.at >= this.count - 1) this.at = -1;
    while (this.playing) {
      const begin = performance.now();
      if (this.at >= this.count - 1) {
        if (!$("repeat").checked) break;
        this.at = -1;
      }
      await this.go(this.at + 1);
      const left = 1000 / Number($("speed").value) - (performance.now() - begin);
      await new Promise(done => setTimeout(done, Math.max(0, left)));
    }
    this.stop();
    this.show(this.at);
  }
}
