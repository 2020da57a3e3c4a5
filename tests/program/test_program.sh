#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# The program as a user meets it: exit codes, threads, stop and resume. Usage: test_program.sh TRIBO SOURCE_DIR
set -euo pipefail
tribo=$1 source=$2
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"
passed=0
fail() { echo "FAILED: $1"; exit 1; }
expect() {  # expect CODE COMMAND...
  local wanted=$1 code=0
  shift
  "$@" >out.txt 2>err.txt || code=$?
  [ "$code" -eq "$wanted" ] || { cat out.txt err.txt; fail "'$*' ended with $code, not $wanted"; }
  passed=$((passed + 1))
}
deck=$source/tests/input/legacy_disks.xml

expect 2 "$tribo"
expect 2 "$tribo" nonsense
expect 2 "$tribo" run
expect 2 "$tribo" run --threads 0 "$deck"
expect 0 "$tribo" --version
expect 0 "$tribo" list GIMP
expect 2 "$tribo" list Nonsense
expect 0 "$tribo" doc mohrcoulomb
grep -q "angle of internal friction" out.txt || fail "doc does not describe a material"
expect 0 "$tribo" doc GridHoriz
expect 2 "$tribo" doc MohrColoumb
grep -q "did you mean 'MohrCoulomb'" err.txt || fail "doc: no 'did you mean'"
expect 0 "$tribo" doc SettingFunction2
grep -q "^property <SettingFunction2> of material RigidContact" out.txt || { cat out.txt; fail "doc: a property"; }
expect 0 "$tribo" doc impulses
grep -q "^attribute Impulses of element <MultiMaterialMode>" out.txt || { cat out.txt; fail "doc: an attribute"; }
expect 0 "$tribo" doc --markdown
cmp out.txt "$source/docs/keywords.md" || fail "docs/keywords.md is old: tribo doc --markdown > docs/keywords.md"
"$tribo" schema | cmp - "$source/docs/editor/workspace/.vscode/tribo.xsd" || fail "docs/editor/workspace/.vscode/tribo.xsd is old"
for shell in bash zsh; do expect 0 "$tribo" completion $shell; done
"$tribo" completion bash >completion.bash
bash -O extglob -c '
  source completion.bash
  tribo() { '"$tribo"' "$@"; }
  COMP_WORDS=(tribo re) COMP_CWORD=1; _tribo; echo "${COMPREPLY[*]}"
  COMP_WORDS=(tribo run --ov) COMP_CWORD=2; _tribo; echo "${COMPREPLY[*]}"
  COMP_WORDS=(tribo doc MohrC) COMP_CWORD=2; _tribo; echo "${COMPREPLY[*]}"' >completed.txt
printf 'resume render report\n--overwrite\nMohrCoulomb\n' | cmp - completed.txt || { cat completed.txt; fail "completion"; }
expect 5 "$tribo" run missing.xml
expect 2 "$tribo"
grep -q "print a summary with checks" err.txt || fail "no list of commands"
expect 2 "$tribo" runn "$deck"
grep -q "there is no command 'runn' (did you mean 'run'?); valid: run, " err.txt || { cat err.txt; fail "runn"; }
expect 2 "$tribo" "$deck"
grep -q "to run this file: tribo run " err.txt || fail "a file without a command"
for file in "$source"/tests/input/malformed/*.xml "$source"/tests/input/malformed_scripts/*.fmcmd; do
  expect 3 "$tribo" check "$file"
  grep -Eq '^[^:]+:[0-9]+:[0-9]+: error: ' err.txt || { cat err.txt; fail "$file: no file:line:col"; }
done
expect 0 "$tribo" check "$deck"

"$tribo" schema >schema.xsd
if command -v xmllint >/dev/null; then
  for file in "$deck" "$source"/input/examples/*.xml; do expect 0 xmllint --noout --noent --schema schema.xsd "$file"; done
fi

# One and two threads, and stopped again and again to be resumed with one and two in turn: the same bits
same_bits() {  # same_bits DECK SECONDS_BETWEEN_STOPS
  rm -rf one two three
  expect 0 "$tribo" run --quiet --threads 1 --output one "$1"
  expect 0 "$tribo" run --quiet --threads 2 --output two "$1"
  local code=0 stops=0 other file
  "$tribo" run --quiet --threads 2 --max-wall 0.02 --output three "$1" >/dev/null 2>&1 || code=$?
  [ $code -eq 6 ] || fail "$1: a run over its wall time ended with $code, not 6"
  while [ $code -eq 6 ]; do
    code=0
    "$tribo" resume --quiet --threads $((stops % 2 + 1)) --max-wall "$2" three >/dev/null 2>&1 || code=$?
    stops=$((stops + 1))
  done
  [ $code -eq 0 ] || fail "$1: resume ended with $code"
  [ $stops -ge 1 ] || fail "$1: the run was never stopped"
  for other in two three; do
    for file in history.csv energy.csv checkpoint.bin run.pvd $(cd one && ls particles/*); do
      cmp "one/$file" "$other/$file" || fail "$1: $other/$file differs"
      passed=$((passed + 1))
    done
  done
}
same_bits "$deck" 0.03
expect 5 "$tribo" run --quiet --output one "$deck"
expect 0 "$tribo" run --quiet --overwrite --threads 1 --output one "$deck"
sed 's|cell "0.0025"|cell "0.00125"|; s|<MaxTime>6e-4|<MaxTime>2e-5|; s|<ArchiveTime>2e-4|<ArchiveTime>1e-5|' \
  "$source/verification/rubbing/case.xml" >rubbing.xml
same_bits rubbing.xml 0.1

# A script gives the same bits as the XML that it converts to, with other values for its variables, too
script=$source/tests/input/falling_blocks.fmcmd
for set in drop=0.5 drop=0.25; do
  rm -rf direct converted && rm -f blocks.xml
  expect 0 "$tribo" run --quiet --set $set -o direct "$script"
  expect 0 "$tribo" convert --set $set "$script" -o blocks.xml
  expect 0 "$tribo" run --quiet -o converted blocks.xml
  for file in history.csv energy.csv checkpoint.bin $(cd direct && ls particles/*); do
    cmp "direct/$file" "converted/$file" || fail "converted/$file differs"
    passed=$((passed + 1))
  done
  cp direct/history.csv "$set.csv"
done
cmp -s drop=0.5.csv drop=0.25.csv && fail "--set changes nothing"
expect 3 "$tribo" check --set dropp=1 "$script"
grep -q "did you mean 'drop'" err.txt || { cat err.txt; fail "--set: no 'did you mean'"; }
expect 2 "$tribo" check --set drop "$script"
code=0
"$tribo" run --quiet --overwrite --np 1 --max-wall 0.001 --set drop=0.25 -o direct "$script" >/dev/null 2>&1 || code=$?
while [ $code -eq 6 ]; do
  code=0
  "$tribo" resume --quiet direct >/dev/null 2>&1 || code=$?
done
cmp direct/history.csv drop=0.25.csv || fail "a resumed run forgets --set"
expect 0 "$tribo" run -a -v -w "$script"

# A signal finishes the step and leaves a checkpoint
"$tribo" run --quiet --output four "$source/input/examples/simple_shear.xml" >/dev/null 2>&1 &
for _ in $(seq 200); do [ -f four/provenance.json ] && break; sleep 0.05; done # written once signals are heard
kill -TERM $! 2>/dev/null || true
code=0
wait $! || code=$?
[ $code -eq 6 ] || [ $code -eq 0 ] || fail "SIGTERM: exit code $code"
[ -f four/checkpoint.bin ] || fail "SIGTERM left no checkpoint"

# An unstable run stops with a message and keeps its last checkpoint
sed 's|<GIMP/>|<GIMP/><TimeFactor>1</TimeFactor>|; s|<E>1.0</E>|<E>1.0</E>|; s|&cell;" symm|\&cell;" symm|' "$deck" >unstable.xml
sed -i 's|"2500"|"250000"|' unstable.xml
code=0
"$tribo" run --quiet --output five unstable.xml >/dev/null 2>err.txt || code=$?
[ $code -eq 4 ] || { cat err.txt; fail "an unstable run ended with $code, not 4"; }
grep -q "particle .* of '" err.txt || fail "the message names no particle"
grep -q '"status": "failed"' five/provenance.json || fail "provenance does not say failed"

# A run that gains energy says so once, and in its record; one that does not says nothing
cutting="$source/input/examples/cutting.fmcmd"
sed 's/Transfer APIC/Transfer XPIC,2/' "$cutting" >gains.fmcmd
expect 0 "$tribo" run --quiet --np 1 --set cell=0.05 --set way=0.3 --output gains gains.fmcmd
[ "$(grep -c '^warning: energy: .* came from nowhere' err.txt)" -eq 1 ] || { cat err.txt; fail "a gain of energy is not told once"; }
grep -q '"to_look_at"' gains/provenance.json || fail "the record does not tell the gain of energy"
expect 0 "$tribo" run --quiet --np 1 --set cell=0.05 --set way=0.3 --output keeps "$cutting"
[ ! -s err.txt ] || { cat err.txt; fail "a good run gives a warning"; }
grep -q '"to_look_at"' keeps/provenance.json && fail "a good run has something to look at"

# A tool whose motion is no number stops it, too
sed 's|<SettingFunction>[^<]*</SettingFunction>|<SettingFunction>log(-1-t)</SettingFunction>|' "$source/input/examples/stacked_blocks.xml" >nowhere.xml
expect 4 "$tribo" run --quiet --output six nowhere.xml
grep -q "SettingFunction" err.txt || { cat err.txt; fail "the message does not name the function"; }

# Only strengths can be reduced
expect 3 "$tribo" safety --quiet --output seven "$source/input/examples/stacked_blocks.xml"
grep -q "no material has a strength" err.txt || { cat err.txt; fail "the message does not say what is missing"; }

# A full disk is an error that leaves nothing half-written
if [ -w /dev/full ]; then
  expect 5 "$tribo" run --quiet --overwrite --output /dev/full/x "$deck"
fi

echo "$passed passed, 0 failed"
