// SPDX-License-Identifier: MIT
// Requests to the server, and the frames that were read last.

export async function ask(path) {
  const answer = await fetch(path);
  if (!answer.ok) throw new Error(await answer.text());
  return answer.json();
}

export async function tell(what) {
  return (await fetch(what, { method: "POST", headers: { "X-Tribo": "1" } })).json();
}

const kept = new Map(), mostKept = 400e6;  // bytes
let bytesKept = 0;

// A line of JSON, and behind it the numbers, part by part.
function decoded(bytes) {
  const view = new Uint8Array(bytes), end = view.indexOf(10);
  const head = JSON.parse(new TextDecoder().decode(view.subarray(0, end))), parts = {};
  let at = end + 1;
  for (const { name, kind, length } of head.parts) {
    parts[name] = kind === "f" ? new Float32Array(bytes, at, length) : new Uint32Array(bytes, at, length);
    at += 4 * length;
  }
  return { head, parts, size: bytes.byteLength };
}

// The frame of a file; `mark` changes if the files may have been written anew.
export async function frameOf(k, query, mark) {
  const key = `${k}?${query}#${mark}`;
  let frame = kept.get(key);
  if (frame) {
    kept.delete(key);  // to be put at the end again
  } else {
    const answer = await fetch(`frame/${k}?${query}`);
    if (!answer.ok) throw new Error(await answer.text());
    frame = decoded(await answer.arrayBuffer());
    bytesKept += frame.size;
  }
  kept.set(key, frame);
  for (const [old, { size }] of kept) {
    if (bytesKept <= mostKept || old === key) break;
    kept.delete(old);
    bytesKept -= size;
  }
  return frame;
}
