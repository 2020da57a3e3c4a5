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
grep -q "<Material Type='MohrCoulomb'" out.txt || fail "doc shows no example"
expect 0 "$tribo" doc GridHoriz
expect 2 "$tribo" doc MohrColoumb
grep -q "did you mean 'MohrCoulomb'" err.txt || fail "doc: no 'did you mean'"
expect 0 "$tribo" doc SettingFunction2
grep -q "^property <SettingFunction2> of material RigidContact" out.txt || { cat out.txt; fail "doc: a property"; }
expect 0 "$tribo" doc impulses
grep -q "^attribute Impulses of element <MultiMaterialMode>" out.txt || { cat out.txt; fail "doc: an attribute"; }
expect 0 "$tribo" doc "angle of friction"
grep -q "nothing has the name 'angle of friction'; these mention it" out.txt && grep -q "material MohrCoulomb" out.txt || fail "doc does not look into descriptions"
expect 0 "$tribo" doc --markdown
cmp out.txt "$source/docs/keywords.md" || fail "docs/keywords.md is old: tribo doc --markdown > docs/keywords.md"
"$tribo" doc --coverage | cmp - "$source/docs/coverage_dialect.md" || fail "docs/coverage_dialect.md is old: tribo doc --coverage > docs/coverage_dialect.md"
"$tribo" schema | cmp - "$source/docs/editor/workspace/.vscode/tribo.xsd" || fail "docs/editor/workspace/.vscode/tribo.xsd is old"
for shell in bash zsh; do expect 0 "$tribo" completion $shell; done
"$tribo" man >tribo.1
for text in '.TH TRIBO 1' '.SS \fBtribo run\fR \fIFILE\fR' '\-\-overwrite' '.SH EXIT STATUS'; do
  grep -qF -- "$text" tribo.1 || fail "the manual page lacks $text"
done
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
expect 0 "$tribo" sweep --quiet "$script" drop=0.5,0.25 -j 2 -o varied
for drop in 0.5 0.25; do cmp varied/drop=$drop/history.csv drop=$drop.csv || fail "sweep: other results than run"; done
head -1 varied/sweep.csv | grep -q '^drop,folder,outcome,time,' || { cat varied/sweep.csv; fail "sweep: columns"; }
[ "$(tail -1 varied/sweep.csv)" = "0.25,drop=0.25,finished,$(tail -1 drop=0.25.csv)" ] || { cat varied/sweep.csv; fail "sweep: rows"; }
expect 5 "$tribo" sweep "$script" drop=0.5 -o varied
grep -q "already holds a run" err.txt || { cat err.txt; fail "sweep replaces results"; }
expect 3 "$tribo" sweep "$script" dropp=0.5
expect 2 "$tribo" sweep "$script" drop
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

# A run that looks wrong says so once, and in its record; one that does not says nothing. That a gain of energy looks
# wrong is shown by the unit tests of the monitor: what this run gained with XPIC was work of the tool that was not counted.
cutting="$source/input/examples/cutting.fmcmd"
cat >torn.xml <<'EOF'
<?xml version='1.0'?>
<JANFEAInput version='3'>
  <Header><Description>A body that is torn apart</Description><Analysis>10</Analysis><ConsistentUnits length='m' mass='kg' time='s'/></Header>
  <MPMHeader><MPMMethod>USL</MPMMethod><GIMP type='quadratic'/><Transfer type='APIC'/><MaxTime>4</MaxTime><ArchiveTime>1</ArchiveTime></MPMHeader>
  <Mesh><Grid xmin='-30' xmax='30' ymin='-5' ymax='5'><Horiz nx='60'/><Vert ny='10'/></Grid></Mesh>
  <MaterialPoints><Body matname='soft'><vel0X>x</vel0X><Rect xmin='-4' xmax='4' ymin='-2' ymax='2'/></Body></MaterialPoints>
  <Material Type='NeoHookean' Name='soft'><rho>1</rho><E>0.01</E><nu>0.3</nu></Material>
</JANFEAInput>
EOF
expect 0 "$tribo" run --quiet --np 1 --output torn torn.xml
[ "$(grep -c "^warning: holes: .* of 'soft'" err.txt)" -eq 1 ] || { cat err.txt; fail "holes are not told once"; }
grep -q '"to_look_at"' torn/provenance.json || fail "the record does not tell the holes"
sed 's/Transfer APIC/Transfer XPIC,2/' "$cutting" >balanced.fmcmd
expect 0 "$tribo" run --quiet --np 1 --set cell=0.05 --set way=0.3 --output balanced balanced.fmcmd
[ ! -s err.txt ] || { cat err.txt; fail "a run with XPIC gives a warning"; }
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

# Functions without a value are named with their place
keyword() {  # keyword NAME SED_EXPRESSION FILE: the run fails with a message that names the keyword and its line
  sed "$2" "$3" >keyword.xml
  cmp -s keyword.xml "$3" && fail "$1: nothing to replace in $3"
  expect 4 "$tribo" run --quiet --overwrite --output keyword keyword.xml
  grep -Eq "keyword.xml:[0-9]+:[0-9]+: the function '.*' of .*$1.* has no finite value" err.txt || { cat err.txt; fail "$1 is not named"; }
  grep -q '"status": "failed"' keyword/provenance.json || fail "$1: provenance does not say failed"
  if grep -rlqE '(^|,)-?(nan|inf)' keyword/*.csv; then fail "$1: a table has something that is not a number"; fi
}
keyword "<Damping>" "s|<GIMP/>|<GIMP/><Damping function='log(-1-t)'/>|" "$deck"
keyword "<PDamping>" "s|<GIMP/>|<GIMP/><PDamping function='log(1-t)/(t>=0)'/>|" "$deck"
keyword "<ParticleBodyXForce>" "s|<Mesh |<Gravity><ParticleBodyXForce>sqrt(-1-t)</ParticleBodyXForce></Gravity><Mesh |" "$deck"

# The folder of a run: only what a run has made is replaced, and two runs do not share it
mkdir own && cp "$deck" own/case.xml && mkdir own/particles own/grid
echo mine | tee own/particles/run_000000.vtp own/grid/mesh own/history.csv >/dev/null
find own -type f -exec md5sum {} + | sort >before.txt
for options in "" --overwrite; do
  expect 5 "$tribo" run --quiet $options --output own own/case.xml
  grep -q "holds 'history.csv', 'particles', not made by a run" err.txt || { cat err.txt; fail "what is in the way"; }
  find own -type f -exec md5sum {} + | sort | cmp - before.txt || fail "a refused run changed files"
done
mv own/particles own/mine && mv own/history.csv own/mine
expect 0 "$tribo" run --quiet --output own own/case.xml
echo mine | tee own/particles/notes >/dev/null
expect 5 "$tribo" run --quiet --output own own/case.xml
expect 0 "$tribo" run --quiet --overwrite --output own own/case.xml
echo mine | tee own/report.html >/dev/null
expect 5 "$tribo" report own
for again in 1 2; do expect 0 "$tribo" report -o own/page.html own; done
for file in report.html particles/notes grid/mesh mine/history.csv mine/run_000000.vtp; do
  [ "$(cat own/$file)" = mine ] || fail "own/$file was changed"
done
expect 3 "$tribo" run --quiet --output none/of/these "$source/tests/input/malformed/$(ls "$source/tests/input/malformed" | head -1)"
[ ! -e none ] || fail "a run that does not start leaves a folder"
"$tribo" run --quiet --overwrite --output four "$source/input/examples/simple_shear.xml" >/dev/null 2>&1 &
first=$!
for _ in $(seq 200); do grep -qs "\"process\": $first" four/provenance.json && break; sleep 0.02; done
kill -STOP $first
expect 5 "$tribo" run --quiet --overwrite --output four "$deck"
grep -q "process $first on " err.txt || { cat err.txt; fail "the other run is not named"; }
expect 5 "$tribo" resume --quiet four
kill -KILL $first
wait $first 2>/dev/null || true
expect 0 "$tribo" run --quiet --overwrite --output four "$deck"

# SIGHUP stops a run with a checkpoint, but not under nohup
for before in "" nohup; do
  $before "$tribo" run --quiet --overwrite --output four "$deck" >/dev/null 2>&1 &
  for _ in $(seq 200); do grep -qs "\"process\": $!" four/provenance.json && break; sleep 0.01; done
  kill -HUP $! 2>/dev/null || true
  code=0
  wait $! || code=$?
  [ $code -eq 0 ] || { [ -z "$before" ] && [ $code -eq 6 ]; } || fail "SIGHUP $before: exit code $code"
done

# A changed command file is told; a project that was moved continues
mkdir project && cp "$deck" project/case.xml
stopped() {
  rm -rf project/out
  code=0
  "$tribo" run --quiet --max-wall 0.02 --output project/out project/case.xml >/dev/null 2>&1 || code=$?
  [ $code -eq 6 ] || fail "the run was not stopped"
}
stopped
sed -i 's|<MaxTime units="ms">20|<MaxTime units="ms">21|' project/case.xml
expect 5 "$tribo" resume --quiet project/out
grep -q '15: - .*<MaxTime units="ms">20<' err.txt && grep -q '15: + .*<MaxTime units="ms">21<' err.txt ||
  { cat err.txt; fail "the changed line is not told"; }
expect 0 "$tribo" resume --quiet --changed project/out
tail -1 project/out/energy.csv | grep -q '^0.021,' || { tail -1 project/out/energy.csv; fail "--changed does not run to the new end"; }
grep -q "changed on resumption" project/out/provenance.json || fail "the change is not recorded"
expect 0 "$tribo" resume --quiet project/out
cp "$deck" project/case.xml
stopped
echo "<!-- nothing -->" >>project/case.xml
mv project moved
expect 0 "$tribo" resume --quiet moved/out
cmp moved/out/history.csv own/history.csv || fail "a moved project gives other results"
mv moved project
stopped
mv project moved && rm moved/case.xml
expect 0 "$tribo" resume --quiet moved/out
grep -q "continues with the copy of the model" err.txt || { cat err.txt; fail "the copy is not told"; }
cmp moved/out/history.csv own/history.csv || fail "the copy of the model gives other results"

# A full disk is an error that leaves nothing half-written
if [ -w /dev/full ]; then
  expect 5 "$tribo" run --quiet --overwrite --output /dev/full/x "$deck"
  code=0
  "$tribo" convert "$script" >/dev/full 2>err.txt || code=$?
  [ $code -eq 5 ] || fail "convert to a full disk ended with $code, not 5"
fi
if [ -c /dev/full ]; then
  expect 5 "$tribo" convert --overwrite -o /dev/full "$script"
  [ -c /dev/full ] || fail "convert has replaced a device by a file"
fi
# So is a file beyond the limit of the user
expect 5 bash -c 'ulimit -f 1 && exec "$0" run --quiet --overwrite -o limited "$1"' "$tribo" "$deck"
grep -q "cannot write '.*': File too large" err.txt || { cat err.txt; fail "the limit of the size of files is not told"; }
expect 0 "$tribo" convert --overwrite -o /dev/stdout "$script"
grep -q "<JANFEAInput" out.txt || fail "convert to /dev/stdout"
mkfifo pipe piped.json
expect 5 timeout 10 "$tribo" report -o pipe own
mkdir piped && mv piped.json piped/tribo-run.json
expect 5 timeout 10 "$tribo" run --quiet -o piped "$deck"

# A name that is not UTF-8
odd=$'n\xff'
cp "$deck" "$odd.xml"
code=0
"$tribo" run --quiet --max-wall 0.02 -o "$odd" "$odd.xml" 2>/dev/null || code=$?
[ $code -eq 6 ] || fail "a name that is not UTF-8: $code"
expect 0 "$tribo" resume --quiet "$odd"
[ ! -s err.txt ] || { cat err.txt; fail "a command file is not found by its name that is not UTF-8"; }
mkdir small
if mount -t tmpfs -o size=1m none small 2>/dev/null; then
  code=0
  "$tribo" run --quiet --output small/out "$deck" 2>err.txt >/dev/null || code=$?
  record=$(cat small/out/provenance.json)
  mount -o remount,size=64m small
  "$tribo" resume --quiet small/out >out.txt 2>&1 || { cat out.txt; umount small; fail "no resumption after a full disk"; }
  umount small
  [ $code -eq 5 ] || { cat err.txt; fail "a full disk ended a run with $code, not 5"; }
  grep -q '"status": "failed"' <<<"$record" || { echo "$record"; fail "the record of a full disk does not say failed"; }
fi

echo "$passed passed, 0 failed"
