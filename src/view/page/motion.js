// SPDX-License-Identifier: MIT
// While the camera moves, only as many particles are drawn as this computer draws fifteen times a second, and larger. If even
// a few are too many for it, the picture has fewer pixels, too.

const wanted = 1000 / 15, patience = 250, least = 2000;  // milliseconds, milliseconds, particles

// At most `most` of the particles, one in each box of a lattice: { chosen: their indices, growth: of their size }.
export function thinned(positions, most, size) {
  const count = positions.length / 3, low = [0, 1, 2].map(d => positions[d]), high = [...low];
  for (let i = 0; i < positions.length; ++i) {
    if (positions[i] < low[i % 3]) low[i % 3] = positions[i];
    if (positions[i] > high[i % 3]) high[i % 3] = positions[i];
  }
  for (let box = size * Math.sqrt(Math.max(1, count / most)); ; box *= 1.2) {
    const nx = Math.floor((high[0] - low[0]) / box) + 1, ny = Math.floor((high[1] - low[1]) / box) + 1, full = new Set(), chosen = [];
    for (let i = 0; i < count && chosen.length <= most; ++i) {
      const x = Math.floor((positions[3 * i] - low[0]) / box), y = Math.floor((positions[3 * i + 1] - low[1]) / box);
      const key = x + nx * (y + ny * Math.floor((positions[3 * i + 2] - low[2]) / box));
      if (!full.has(key)) { full.add(key); chosen.push(i); }
    }
    if (chosen.length <= most) return { chosen, growth: Math.max(1, 1.1 * box / size) };
  }
}

export class Motion {
  // `draw` draws at most so many particles and returns how many they are; `blur` makes the picture coarse, or fine again.
  constructor(interactor, draw, blur) {
    this.draw = draw;
    this.blur = blur;
    this.coarse = this.blurred = false;  // needed in the last motion, and now
    this.speed = Infinity;  // particles per millisecond
    this.total = this.count = 0;
    this.tooMany = Infinity;
    interactor.onStartAnimation(() => { clearTimeout(this.ended); this.before = 0; this.setCoarse(this.coarse); this.adapt(); });
    interactor.onAnimation(() => this.frame());
    interactor.onEndAnimation(() => { clearTimeout(this.ended); this.ended = setTimeout(() => this.rest(), patience); });
  }
  // So many particles were drawn, all that there are, within a time.
  drawn(count, milliseconds) {
    this.total = this.count = count;
    this.tooMany = Infinity;
    if (count > least) this.speed = count / Math.max(1, milliseconds);
  }
  // How many particles take a time.
  within(milliseconds) { return Math.max(least, this.speed * milliseconds); }
  frame() {
    const now = performance.now(), interval = now - this.before;
    const slow = interval > 1.4 * wanted, fast = this.count < this.total && interval < 0.6 * wanted;
    if (this.before && (slow || fast)) this.speed = this.count / interval;
    if (this.before && slow) this.tooMany = this.count;
    if (this.before && slow && this.speed * wanted < least) this.setCoarse(this.coarse = true);
    this.before = now;
    this.adapt();
  }
  // More only step by step, and not as many as were too many before.
  adapt() {
    const most = Math.min(this.total, this.within(wanted), this.count < this.total ? Math.min(2 * this.count, 0.7 * this.tooMany) : Infinity);
    if (most < 0.7 * this.count || most > 1.5 * this.count) this.count = this.draw(Math.max(least, most));
  }
  setCoarse(coarse) {
    if (coarse !== this.blurred) this.blur(this.blurred = coarse);
  }
  // All particles and pixels again.
  rest() {
    clearTimeout(this.ended);
    this.setCoarse(false);
    if (this.count < this.total) this.count = this.draw(this.total);
  }
}
