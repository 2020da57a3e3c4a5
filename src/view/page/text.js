// SPDX-License-Identifier: MIT
// Numbers and elements of the page.

export const $ = id => document.getElementById(id);

export const short = x => x === null || Number.isNaN(x) ? "-" : x === 0 ? "0"
  : Math.abs(x) >= 1e5 || Math.abs(x) < 1e-3 ? Number(x.toPrecision(4)).toExponential().replace("e+", "e") : Number(x.toPrecision(4)).toString();

export const seconds = s => s < 90 ? s.toFixed(0) + " s" : s < 5400 ? (s / 60).toFixed(0) + " min" : (s / 3600).toFixed(1) + " h";

export const withUnit = (name, unit) => unit ? `${name} [${unit}]` : name;

// An element with a class, a text and children.
export function element(kind, { text, ...rest } = {}, ...children) {
  const out = Object.assign(document.createElement(kind), rest);
  if (text !== undefined) out.textContent = text;
  out.append(...children);
  return out;
}

// Round numbers between two values, about so many.
export function ticks(low, high, wanted) {
  const raw = (high - low) / Math.max(1, wanted), power = 10 ** Math.floor(Math.log10(raw)), part = raw / power;
  if (!(raw > 0) || !Number.isFinite(raw)) return [low];
  const step = power * (part < 1.5 ? 1 : part < 3.5 ? 2 : part < 7.5 ? 5 : 10), out = [];
  for (let k = Math.ceil(low / step - 1e-9); k * step <= high + 1e-9 * step && out.length < 50; ++k) out.push(k * step);
  return out;
}
