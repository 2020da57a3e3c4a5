# SPDX-License-Identifier: MIT
"""Runs verification cases: a command file in, numbers against a reference out.

    scripts/verify            all cases; writes docs/verification.md and docs/figures
    scripts/verify NAME ...   some of them; the results of the others are kept
    scripts/verify --quick    the quick checks only, without figures; ctest runs one case at a time

A case is a folder with README.md (source, what is compared, why the tolerance) and check.py with `run(case)`.
"""

import argparse
import concurrent.futures
import contextlib
import csv
import datetime
import importlib.util
import io
import json
import multiprocessing
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

root = pathlib.Path(__file__).resolve().parent.parent
sys.path.insert(0, str(root / "scripts"))

import numpy as np  # noqa: E402

import vtp  # noqa: E402


class Case:
    """What a check.py works with."""

    def __init__(self, name, tribo, quick):
        self.name, self.tribo, self.quick = name, tribo, quick
        self.folder = root / "verification" / name
        self.scratch = pathlib.Path(tempfile.mkdtemp(prefix=f"tribo-{name}-"))
        self.results, self.figures, self.tables = [], [], []

    def deck(self, label, file, entities, replace):
        """A command file with entities (and texts) replaced."""
        text = (self.folder / file).read_text()
        for entity, value in (entities or {}).items():
            text, count = re.subn(rf'<!ENTITY {entity} "[^"]*">', f'<!ENTITY {entity} "{value}">', text)
            if count != 1:
                raise SystemExit(f"{self.name}/{file} has no entity {entity}")
        for old, new in (replace or {}).items():
            if old not in text:
                raise SystemExit(f"{self.name}/{file} has no text {old!r}")
            text = text.replace(old, new)
        deck = self.scratch / f"{label}.xml"
        deck.write_text(text)
        return deck

    def call(self, command, deck, out):
        done = subprocess.run([self.tribo, command, "--quiet", "--overwrite", "--output", out, deck], capture_output=True, text=True)
        if done.returncode != 0:
            raise SystemExit(f"{deck}: exit code {done.returncode}\n{done.stderr}")
        return out

    def run(self, label, file="case.xml", entities=None, replace=None):
        """Runs a command file with entities (and texts) replaced; returns the folder of its results."""
        return self.call("run", self.deck(label, file, entities, replace), self.scratch / f"{label}.out")

    def drive(self, label, drive, law, file="case.xml"):
        """Drives a law: the texts of <Drive> and of its <Material>; returns the columns of the table by name."""
        return table(self.call("drive", self.deck(label, file, dict(drive=drive, law=law), None), self.scratch / f"{label}.csv"))

    def check(self, what, measured, reference, tolerance, kind="relative"):
        """kind: relative or absolute error against the reference, or `at most` the tolerance."""
        measured = float(measured)
        if kind == "at most":
            error = measured
        else:
            error = abs(measured - reference) / (abs(reference) if kind == "relative" else 1.0)
        passed = bool(error <= tolerance)
        self.results.append(dict(what=what, measured=measured, reference=reference, error=error, tolerance=tolerance, kind=kind, passed=passed))
        print(f"{'ok  ' if passed else 'FAIL'} {self.name}: {what}: {measured:.10g}"
              + ("" if kind == "at most" else f" (reference {reference:.10g}, error {error:.2g})") + f", tolerance {tolerance:g}", flush=True)

    def table(self, title, columns, rows):
        """Adds a table of texts to the report: what is shown but not demanded."""
        self.tables.append(dict(title=title, columns=columns, rows=rows))

    def figure(self, name, draw):
        """Saves a figure to the docs; draw(axes). Not in quick runs."""
        if self.quick:
            return
        import matplotlib

        matplotlib.use("Agg")
        import matplotlib.pyplot as plt

        figure, axes = plt.subplots(figsize=(6.4, 4.0), layout="constrained")
        draw(axes)
        (root / "docs/figures").mkdir(parents=True, exist_ok=True)
        figure.savefig(root / f"docs/figures/{name}.png", dpi=110)
        plt.close(figure)
        self.figures.append(name)


def table(path):
    """Columns of a CSV as arrays by name."""
    with open(path) as file:
        rows = list(csv.reader(file))
    return {name: np.array([float(row[k] or "nan") for row in rows[1:]]) for k, name in enumerate(rows[0])}


def history(folder):
    return table(f"{folder}/history.csv")


def middles(time):
    """Times to which contact forces in the rows of a history belong: each is the mean over the time since the row before."""
    return np.concatenate([time[:1], 0.5 * (time[:-1] + time[1:])])


def energy(folder):
    return table(f"{folder}/energy.csv")


def momentum_defect(folder):
    """Largest difference between the momentum gained and the impulses from outside."""
    rows = energy(folder)
    momentum, impulse = (np.stack([rows[f"{name}_{axis}"] for axis in "xyz"], axis=1) for name in ("momentum", "impulse"))
    return np.abs(momentum - momentum[0] - impulse).max()


def last_particles(folder):
    return vtp.read(vtp.collection(folder)[-1][1])


def write_report(store):
    version = subprocess.run([os.environ["TRIBO"], "--version"], capture_output=True, text=True).stdout.strip()
    lines = ["# Verification", "", "Written by `scripts/verify`; each case is a folder of `verification/` with its command file, source and reasons.", "",
             f"Program: `{version}`.", ""]
    lines += (root / "verification/limits.md").read_text().split("\n")
    for name in sorted(store):
        entry = store[name]
        lines += [f"## {entry['title']}", "", f"`verification/{name}`, run {entry['date']}", "",
                  "| check | measured | reference | error | tolerance | |", "|-|-|-|-|-|-|"]
        for r in entry["results"]:
            reference = "" if r["kind"] == "at most" else f"{r['reference']:.10g}"
            lines.append(f"| {r['what']} | {r['measured']:.8g} | {reference} | {r['error']:.2g} | {r['tolerance']:g} | {'pass' if r['passed'] else '**fail**'} |")
        lines.append("")
        for table in entry.get("tables", []):
            lines += [table["title"] + ":", "", "| " + " | ".join(table["columns"]) + " |", "|" + "-|" * len(table["columns"])]
            lines += ["| " + " | ".join(row) + " |" for row in table["rows"]] + [""]
        lines += [f"![{f}](figures/{f}.png)\n" for f in entry["figures"]]
    (root / "docs/verification.md").write_text("\n".join(lines))


def run_case(name, tribo, quick):
    """Name, what goes into the report (or why it stopped), and what was printed."""
    folder = root / "verification" / name
    spec = importlib.util.spec_from_file_location(name, folder / "check.py")
    module = importlib.util.module_from_spec(spec)
    sys.modules["verify"] = sys.modules["__main__"]
    printed = io.StringIO()
    with contextlib.redirect_stdout(printed):
        try:
            spec.loader.exec_module(module)
            case = Case(name, tribo, quick)
            module.run(case)
        except SystemExit as stop:
            return name, str(stop.code), printed.getvalue()
        if all(r["passed"] for r in case.results):
            shutil.rmtree(case.scratch)
        else:
            print(f"     {name}: its files are in {case.scratch}")
    title = (folder / "README.md").read_text().splitlines()[0].lstrip("# ")
    entry = dict(title=title, date=datetime.date.today().isoformat(), results=case.results, figures=case.figures, tables=case.tables)
    return name, entry, printed.getvalue()


def main():
    folder = root / "verification"
    known = sorted(p.parent.name for p in folder.glob("*/check.py"))
    parser = argparse.ArgumentParser(description="Runs cases of the verification with the program that TRIBO names.")
    parser.add_argument("cases", nargs="*", metavar="case", help="all if none is given: " + ", ".join(known))
    parser.add_argument("--quick", action="store_true", help="only the fast checks of each case; nothing is recorded")
    arguments = parser.parse_args()
    for name in arguments.cases:
        if name not in known:
            parser.error(f"there is no case '{name}'; valid: {', '.join(known)}")
    quick, names, tribo = arguments.quick, arguments.cases or known, os.environ["TRIBO"]
    record = root / "docs/verification.json"
    store = json.loads(record.read_text()) if record.exists() else {}
    store = {name: entry for name, entry in store.items() if (folder / name).exists()}
    # Cases side by side, each on one processor; what they print stays together.
    os.environ.setdefault("OMP_NUM_THREADS", "1")
    failed = total = 0
    stopped = []
    with concurrent.futures.ProcessPoolExecutor(os.cpu_count(), multiprocessing.get_context("fork")) as pool:
        for running in concurrent.futures.as_completed([pool.submit(run_case, name, tribo, quick) for name in names]):
            name, entry, printed = running.result()
            print(printed, end="", flush=True)
            if isinstance(entry, str):
                print(f"STOP {name}: {entry}", flush=True)
                stopped.append(name)
                continue
            failed += sum(not r["passed"] for r in entry["results"])
            total += len(entry["results"])
            store[name] = entry
            if not quick:  # after each case, so that a run that is interrupted keeps what it has
                store = dict(sorted(store.items()))
                record.write_text(json.dumps(store, indent=1) + "\n")
                write_report(store)
    print(f"{total - failed} passed, {failed} failed" + (f"; stopped: {', '.join(stopped)}" if stopped else ""))
    sys.exit(1 if failed or stopped else 0)


if __name__ == "__main__":
    main()
