# SPDX-License-Identifier: MIT
"""A run of a sweep in a process of its own: reads the task from the standard input, prints None or the error."""

import json
import sys
import warnings

from . import _core
from .errors import ModelWarning, TriboError


def work(task):
    """Runs the model of a task to its end."""
    values = task["set"]
    if task["text"] is None:
        model = _core.read_file(task["file"], values)
    else:
        model = _core.read_text(task["text"], task["name"], values)
    _core.run(model, {"folder": task["folder"], "threads": task["threads"], "overwrite": task["overwrite"],
                      "quiet": True, "command_line": f"tribo.sweep({task['name']!r}, {values!r})"})


if __name__ == "__main__":
    warnings.simplefilter("ignore", ModelWarning)
    try:
        work(json.load(sys.stdin))
        answer = [None, None]
    except TriboError as error:
        answer = [type(error).__name__, str(error)]
    print("\n" + json.dumps(answer))
