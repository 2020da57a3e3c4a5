#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# The benchmark of the README against its closed form. Usage: test_example.sh TRIBO PYTHON SOURCE_DIR
set -euo pipefail
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"
"$1" run --quiet "$3/input/examples/simple_shear.xml"
"$2" "$3/scripts/compare_simple_shear.py" simple_shear.out
