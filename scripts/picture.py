#!/usr/bin/python3
# SPDX-License-Identifier: MIT
"""Pictures of the particles of a run: picture.py FOLDER FIELD OUTPUT.png [TIME ...]

FIELD is the name of a scalar, or of a vector for its length. Without times: start, middle and end.
"""

import sys

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np

import vtp

folder, field, output = sys.argv[1:4]
files = vtp.collection(folder)
times = [float(t) for t in sys.argv[4:]] or [files[0][0], files[len(files) // 2][0], files[-1][0]]
chosen = [min(files, key=lambda f: abs(f[0] - t)) for t in times]
frames = [vtp.read(path) for _, path in chosen]


def values(frame):
    v = frame[field]
    return np.linalg.norm(v, axis=1) if v.ndim > 1 else v


low, high = min(values(f).min() for f in frames), max(np.percentile(values(f), 99.5) for f in frames)
points = np.concatenate([f["points"] for f in frames])
left, right = points[:, 0].min(), points[:, 0].max()
bottom, top = points[:, 1].min(), points[:, 1].max()
margin = 0.03 * max(right - left, top - bottom)
aspect = (top - bottom + 2 * margin) / (right - left + 2 * margin)
width = 4.2
figure, axes = plt.subplots(1, len(frames), figsize=(width * len(frames), width * aspect + 0.9), layout="constrained")
for axis, frame, (time, _) in zip(np.atleast_1d(axes), frames, chosen):
    size = np.sqrt(frame["volume"].mean()) if "volume" in frame else np.sqrt((top - bottom) * (right - left) / len(frame["points"]))
    scale = 72 * width / (right - left + 2 * margin)
    shown = axis.scatter(frame["points"][:, 0], frame["points"][:, 1], c=values(frame), s=(size * scale) ** 2 * 1.1, vmin=low,
                         vmax=high, cmap="turbo", linewidths=0, marker="s")
    axis.set_xlim(left - margin, right + margin)
    axis.set_ylim(bottom - margin, top + margin)
    axis.set_aspect("equal")
    axis.set_title(f"time {time:.4g}", fontsize=10)
    axis.tick_params(labelsize=8)
figure.colorbar(shown, ax=axes, label=field, shrink=0.9)
figure.savefig(output, dpi=110)
