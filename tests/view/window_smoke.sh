#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Drives the window as a person would, under Xvfb: load, cut, undo, redo, grasp, record, replay, quit. What the window
# did is read off its recording and its pictures. usage: window_smoke.sh BIN-FOLDER WORK-FOLDER
set -euo pipefail
here=$(cd -- "$(dirname -- "${BASH_SOURCE[0]}")" && pwd)
bin=$(cd -- "$1" && pwd)
rm -rf -- "$2"
mkdir -p -- "$2"
cd -- "$2"

fail() {
  printf 'window_smoke: %s\n' "$*" >&2
  [ ! -s said.txt ] || sed 's/^/the window said: /' said.txt >&2
  exit 1
}
skip() {
  printf 'window_smoke: skipped: %s\n' "$*"
  exit 77
}
command -v Xvfb >/dev/null || skip "there is no Xvfb (package xvfb)"
command -v xdotool >/dev/null || skip "there is no xdotool"

window=
server=
arm=
end() {
  [ -z "$arm" ] || kill "$arm" 2>/dev/null || true
  [ -z "$window" ] || kill "$window" 2>/dev/null || true
  [ -z "$server" ] || kill "$server" 2>/dev/null || true
}
trap end EXIT

# A server of this test's own. Its number comes from Xvfb, which takes the first that is free. With -noreset it stays as
# it is when a client leaves: by default it starts anew when the last one does, and whoever connects meanwhile is told
# that the display cannot be opened.
start_server() {
  unset DISPLAY WAYLAND_DISPLAY XAUTHORITY
  Xvfb -displayfd 3 -screen 0 1280x800x24 +extension GLX -nolisten tcp -noreset 3>display.txt >/dev/null 2>server.txt &
  server=$!
  wait_for "the number of Xvfb's display" grep -q '^[0-9][0-9]*$' display.txt
  DISPLAY=:$(cat display.txt)
  export DISPLAY
  wait_for "an answer of Xvfb" answers
}
answers() { [ "$(xdotool getdisplaygeometry)" = "1280 800" ]; }
wait_for() { # wait_for WHAT COMMAND...: until the command succeeds; 600 or $tries times
  local what=$1 i
  shift
  for ((i = 0; i < ${tries:-600}; ++i)); do
    if "$@" >/dev/null 2>&1; then return 0; fi
    [ -z "$window" ] || kill -0 "$window" 2>/dev/null || fail "it ended while waiting for $what"
    kill -0 "$server" 2>/dev/null || fail "Xvfb ended while waiting for $what: $(cat server.txt)"
    sleep 0.1
  done
  fail "waited in vain for $what"
}

open_window() { # open_window ARGUMENT...
  "$bin/incise-view" "$@" >told.txt 2>said.txt &
  window=$!
  wait_for "the window" xdotool search --onlyvisible --pid "$window"
  # Its first picture tells that it takes keys.
  wait_for "a first picture" take_picture first 10
}
take_picture() { # take_picture NAME [TRIES]: by the key for it, as NAME.png; waits for a minute, or TRIES fifths of a second
  local before after i
  before=$(find . -maxdepth 1 -name 'incise-[0-9]*.png' | wc -l)
  xdotool key s
  for ((i = 0; i < ${2:-300}; ++i)); do
    sleep 0.2
    after=$(find . -maxdepth 1 -name 'incise-[0-9]*.png' -size +0 | wc -l)
    [ "$after" -gt "$before" ] && break
  done
  [ "$after" -gt "$before" ] || return 1
  mv -- "$(find . -maxdepth 1 -name 'incise-[0-9]*.png' | sort | tail -n 1)" "$1.png"
}
drag() { # drag X0 Y0 X1 Y1: with the left button, in 25 moves
  local i
  xdotool mousemove "$1" "$2" mousedown 1
  for ((i = 1; i <= 25; ++i)); do
    xdotool mousemove $(($1 + ($3 - $1) * i / 25)) $(($2 + ($4 - $2) * i / 25))
    sleep 0.03
  done
  xdotool mouseup 1
}
quit_window() {
  local status=0
  xdotool key ctrl+q
  wait "$window" || status=$?
  window=
  [ "$status" = 0 ] || fail "it ended with $status"
  [ ! -s said.txt ] || fail "it complained"
}
shape() { python3 "$here/pointer_shape.py"; }
looks_as() { [ "$(shape)" = "$1" ]; }
looks_otherwise() { local now; now=$(shape) && [ "$now" != "$1" ]; }
has() { grep -q -- "$1" session.jsonl; }
lifted() { has '"blade"' && ! tail -n 1 session.jsonl | grep -q '"blade"'; }
picked() { "$bin/incise_picture_check" "$@" || fail "pictures $*"; }
changed() { take_picture "$2" && "$bin/incise_picture_check" "$1.png" "$2.png"; } # changed BEFORE AFTER

start_server

# A hand at a haptic device, whose service breaks off now and then: it cuts, and the window stays.
if [ -x "$bin/fake_haply" ]; then
  "$bin/fake_haply" 0 drop >arm.txt &
  arm=$!
  wait_for "the haptic service" grep -q '^haply=' arm.txt
  open_window --device "$(head -n 1 arm.txt)" --record session.jsonl
  wait_for "a blade at the device" has '"blade"'
  wait_for "a stroke that ended" lifted
  sleep 3
  quit_window
  kill "$arm"
  wait "$arm" 2>/dev/null || true
  arm=
  "$bin/incise" replay session.jsonl --verify >/dev/null || fail "the hand's recording does not come out as it was"
  rm session.jsonl
fi

# A cube that is loaded, cut, mended, cut again, pulled at; all of it recorded.
open_window --record session.jsonl
take_picture uncut || fail "no picture of the cube"
picked uncut.png
# The pointer tells what a press would do: on a panel, on tissue with a tool, where a drag turns the view.
xdotool mousemove 36 72
if shape >/dev/null; then
  sleep 0.5
  arrow=$(shape)
  xdotool mousemove 640 360
  tries=100 wait_for "a pointer for a tool on tissue" looks_otherwise "$arrow"
  cross=$(shape)
  xdotool key 1 mousemove 644 364
  tries=100 wait_for "a pointer for turning the view" looks_otherwise "$cross"
  xdotool mousemove 36 72
  tries=100 wait_for "the arrow on a panel" looks_as "$arrow"
  xdotool key 2
fi
drag 560 340 760 400
wait_for "the end of a stroke" lifted
wait_for "a picture of the cut" changed uncut cut
# Clicks that come and go between two pictures count, each where it was: on the buttons for undo and a picture.
kill -STOP "$window"
for place in '433 684' '804 684'; do xdotool mousemove $place click 1; done
xdotool mousemove 640 200
kill -CONT "$window"
wait_for "undo, by a click between two pictures" has '"undo"'
wait_for "a picture, by a click between two pictures" test -s incise-0001.png
rm incise-0001.png
xdotool key ctrl+shift+z
wait_for "redo" has '"redo"'
xdotool key 4
drag 460 420 400 330
wait_for "a grasp" has '"hooks"'
for key in w c c c x Page_Down q t o b p p p h h 6 5 3 2 1 f plus minus Left space period space; do xdotool key $key; done
sleep 0.5
take_picture shown || fail "no picture after all keys"
quit_window
"$bin/incise" replay --verify session.jsonl >replayed.txt || fail "the recording does not replay: $(cat replayed.txt)"

# The recording, played to the end of its first step, then gone on with by hand and recorded again.
open_window --paused session.jsonl
take_picture before || fail "no picture of the replay"
xdotool key n
wait_for "a picture of the next step" changed before step
xdotool key g
sleep 0.5
xdotool key v
wait_for "a second recording" test -s incise-recording-0001.jsonl
xdotool key 2
drag 620 520 760 560
sleep 0.5
xdotool key v
sleep 0.5
quit_window
"$bin/incise" replay --verify incise-recording-0001.jsonl >replayed.txt ||
  fail "the second recording does not replay: $(cat replayed.txt)"

# What cannot be opened, and where there is no display.
status=0
"$bin/incise-view" told.txt >out.txt 2>&1 || status=$?
[ "$status" = 3 ] && grep -q told.txt out.txt || fail "a file that is no mesh: exit $status, $(cat out.txt)"
status=0
env -u DISPLAY -u WAYLAND_DISPLAY "$bin/incise-view" >out.txt 2>&1 || status=$?
[ "$status" = 5 ] && grep -q -- --headless out.txt || fail "without a display: exit $status, $(cat out.txt)"
env -u DISPLAY "$bin/incise-view" --headless --replay session.jsonl --frame 40 --screenshot headless.png --size 640x360 \
  2>out.txt || fail "headless, without a display"
picked headless.png
[ "$(cat out.txt)" = "incise-view: wrote headless.png (picture, 640 x 360 pixels)" ] || fail "it said $(cat out.txt)"
"$bin/incise-view" --headless -q --screenshot quiet.png --size 64x48 2>out.txt || fail "quiet"
[ ! -s out.txt ] || fail "-q said $(cat out.txt)"

# A scan: its --size is that of tets, and neither the window nor a picture is that small.
{
  printf 'ObjectType = Image\nNDims = 3\nBinaryData = True\nElementSpacing = 1 1 1\nDimSize = 12 12 12\n'
  printf 'ElementType = MET_UCHAR\nElementDataFile = LOCAL\n'
  head -c 1728 /dev/zero | tr '\0' '\1'
} >scan.mha
mkdir temporary
TMPDIR=$PWD/temporary "$bin/incise-view" --headless scan.mha --size 4 --screenshot scan.png 2>out.txt || fail "a scan: $(cat out.txt)"
[ -z "$(ls temporary)" ] || fail "a picture of a scan left $(ls temporary)"
! grep -qv '^incise-view: ' out.txt || fail "a picture of a scan: $(cat out.txt)"
grep -q 'wrote scan.png (picture, 1280 x 720 pixels)' out.txt || fail "a picture of a scan: $(cat out.txt)"
"$bin/incise-view" --headless -q scan.mha --size 4 --size 320x200 --screenshot small.png 2>out.txt || fail "two sizes"
open_window scan.mha --size 4
geometry=$(xdotool getwindowgeometry "$(xdotool search --onlyvisible --pid "$window" | tail -n 1)")
[[ $geometry == *'Geometry: 1280x'* ]] || fail "the window of a scan: $geometry"
kill "$window"
wait "$window" 2>/dev/null || true
window=

# A film: what ffmpeg is asked for, and what is said where there is none.
mkdir stand-in
printf '#!/bin/sh\nprintf "%%s\\n" "$@" >film.txt\nfor last; do :; done\nls "$(dirname "$7")" >pictures.txt\n: >"$last"\n' \
  >stand-in/ffmpeg
chmod +x stand-in/ffmpeg
PATH=$PWD/stand-in:$PATH "$bin/incise-view" --headless -q --frame 4 --every 2 --film film.mp4 --size 64x48 || fail "a film"
[ -e film.mp4 ] && [ "$(cat pictures.txt | wc -l)" = 3 ] || fail "ffmpeg was asked for $(cat film.txt)"
status=0
PATH=/nowhere "$bin/incise-view" --headless -q --film none.mp4 --size 64x48 2>out.txt || status=$?
[ "$status" != 0 ] && grep -q 'needs the program ffmpeg' out.txt || fail "without ffmpeg: exit $status, $(cat out.txt)"
status=0
"$bin/incise-view" --heedless 2>out.txt || status=$?
[ "$status" = 2 ] && grep -q '^incise-view: error: .*(did you mean --headless?); see incise-view --help$' out.txt ||
  fail "an unknown option: exit $status, $(cat out.txt)"
for name in - picture.txt; do
  status=0
  "$bin/incise-view" --headless --screenshot "$name" 2>out.txt || status=$?
  [ "$status" = 2 ] && [ ! -e "./$name" ] || fail "--screenshot $name: exit $status, $(cat out.txt)"
done
echo "window_smoke: all steps passed"
