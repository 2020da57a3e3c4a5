# SPDX-License-Identifier: MIT
import importlib.util
import pathlib
import re
import subprocess

import numpy as np

import verify

here = pathlib.Path(__file__).parent
spec = importlib.util.spec_from_file_location("generated_models", here / "models.py")
models = importlib.util.module_from_spec(spec)
spec.loader.exec_module(models)


def keeps_noise(options):
    """FLIP and XPIC keep velocities of particles that the grid does not see."""
    return options["transfer"].startswith(("FLIP", "XPIC"))


def measure(case, number, model=models.model, change_text=None):
    """Options, largest mean energy over the initial one, relative change of momentum, and the message of a run that stopped."""
    options, text = model(number)
    name = f"{model.__name__}_{number}"
    if change_text:
        name, text = f"{name}_changed", change_text(text)
    deck, out = case.scratch / f"{name}.xml", case.scratch / f"{name}.out"
    deck.write_text(text)
    done = subprocess.run([case.tribo, "run", "--quiet", "--overwrite", "--output", out, deck], capture_output=True, text=True)
    if done.returncode == 3:
        raise SystemExit(done.stderr)
    e = verify.energy(out)
    total = e["kinetic"] + e["elastic"] + e["interface"]
    width = max(1, len(total) // 8)
    mean = np.convolve(total, np.ones(width) / width, "valid")
    axes = "y" if options["analysis"] == "axisymmetric" else "xyz"
    change = np.sqrt(sum((e[f"momentum_{x}"] - e[f"momentum_{x}"][0]) ** 2 for x in axes)).max()
    mass = 2 * e["kinetic"][0] / 0.05**2  # a lower bound, as no body is faster than 0.054
    return options, mean.max() / total[0], change / (mass * 0.05), done.stderr if done.returncode else ""


def thin_plates(case):
    """Plates of one to three cells: nodes that they hardly reach must not add energy."""
    found = [measure(case, number, models.thin_model) for number in range(6 if case.quick else 120)]
    for label, filtered in (("FLIP and APIC", False), ("FMPM", True)):
        gains = [gain for options, gain, _, _ in found if options["transfer"].startswith("FMPM") == filtered]
        case.check(f"thin plates: largest energy over the initial one, {len(gains)} models with {label}", max(gains), 0, 1.01, "at most")
    case.check("thin plates: runs that stop", sum(1 for *_, message in found if message), 0, 0, "at most")


def without_law(text):
    """All bodies have one velocity field: they are one body, and no law acts."""
    return re.sub(r"<MultiMaterialMode.*</MultiMaterialMode>", "", text)


def with_half_step(text):
    return text.replace("<TimeFactor>0.4</TimeFactor>", "<TimeFactor>0.2</TimeFactor>")


def causes(case, found):
    """The few models that gain more than 1 %: undamped FLIP does so without any law, XPIC by its time step."""
    for options, gain, _, _ in found:
        if gain <= 1.01:
            continue
        label = f"model {options['number']} ({options['transfer']}, {options['order']}), which gains {100 * (gain - 1):.1f} %"
        if options["transfer"] == "FLIP":
            _, other, _, _ = measure(case, options["number"], change_text=without_law)
            case.check(f"{label}: more than the same bodies without a law", gain - other, 0, 0.01, "at most")
        else:
            _, other, _, _ = measure(case, options["number"], change_text=with_half_step)
            case.check(f"{label}: energy over the initial one with half the step", other, 0, 1.01, "at most")


def run(case):
    thin_plates(case)
    numbers = [*range(12), 27, 54] if case.quick else range(200)  # 27 and 54: light nodes, FLIP with a part of PIC
    found = [measure(case, number) for number in numbers]
    gains = [gain for _, gain, _, _ in found]
    noisy = [keeps_noise(options) for options, *_ in found]
    changes = [change for _, _, change, _ in found]
    silent = [options for options, _, _, message in found if message and "error" not in message]
    for label, of, limit in (("APIC and FMPM", False, 1.01), ("FLIP and XPIC", True, 1.025)):
        group = [gain for gain, noise in zip(gains, noisy) if noise == of]
        case.check(f"largest energy over the initial one, {len(group)} models with {label}", max(group), 0, limit, "at most")
    case.check(f"largest change of momentum, {len(changes)} models", max(changes), 0, 1e-12, "at most")
    case.check("runs that stop without a reason", len(silent), 0, 0, "at most")
    if case.quick:
        return
    causes(case, found)
    stopped = sum(1 for *_, message in found if message)
    rows = []
    for key in ("law", "transfer", "order", "kernel", "analysis"):
        groups = {}
        for options, gain, _, _ in found:
            groups.setdefault(options[key].split(" ")[0] if key == "law" else options[key], []).append(gain)
        rows += [[key, word, str(len(g)), f"{np.median(g):.4f}", f"{max(g):.4f}"] for word, g in sorted(groups.items())]
    case.table(f"Energy over the initial one ({stopped} of {len(found)} runs stopped with a message)", ["option", "value", "models", "median", "largest"], rows)

    def draw(axes):
        axes.hist(gains, bins=40)
        axes.set_xlabel("largest energy over the initial energy")
        axes.set_ylabel("models")

    case.figure("generated_models", draw)
