#!/usr/bin/env bash
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
expect 3 "$tribo" list Nonsense
expect 5 "$tribo" run missing.xml
for file in "$source"/tests/input/malformed/*.xml; do
  expect 3 "$tribo" check "$file"
  grep -Eq '^[^:]+:[0-9]+:[0-9]+: error: ' err.txt || { cat err.txt; fail "$file: no file:line:col"; }
done
expect 0 "$tribo" check "$deck"

"$tribo" schema >schema.xsd
if command -v xmllint >/dev/null; then
  for file in "$deck" "$source"/input/examples/*.xml; do expect 0 xmllint --noout --noent --schema schema.xsd "$file"; done
fi

expect 0 "$tribo" run --quiet --threads 1 --output one "$deck"
expect 5 "$tribo" run --quiet --output one "$deck"
expect 0 "$tribo" run --quiet --overwrite --threads 1 --output one "$deck"
expect 0 "$tribo" run --quiet --threads 2 --output two "$deck"

# Stopped again and again, resumed with one and two threads in turn
code=0
"$tribo" run --quiet --threads 2 --max-wall 0.02 --output three "$deck" >/dev/null 2>&1 || code=$?
[ $code -eq 6 ] || fail "a run over its wall time ended with $code, not 6"
stops=0
while [ $code -eq 6 ]; do
  code=0
  "$tribo" resume --quiet --threads $((stops % 2 + 1)) --max-wall 0.03 three >/dev/null 2>&1 || code=$?
  stops=$((stops + 1))
done
[ $code -eq 0 ] || fail "resume ended with $code"
[ $stops -gt 1 ] || fail "the run was never stopped"
for other in two three; do
  for file in history.csv energy.csv checkpoint.bin run.pvd $(cd one && ls particles/*); do
    cmp "one/$file" "$other/$file" || fail "$other/$file differs"
    passed=$((passed + 1))
  done
done

# A signal finishes the step and leaves a checkpoint
"$tribo" run --quiet --output four "$source/input/examples/simple_shear.xml" >/dev/null 2>&1 &
sleep 0.15
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

# A full disk is an error that leaves nothing half-written
if [ -w /dev/full ]; then
  expect 5 "$tribo" run --quiet --overwrite --output /dev/full/x "$deck"
fi

echo "$passed passed, 0 failed"
