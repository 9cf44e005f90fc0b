#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Drives incise-view under Xvfb as a restless person would: random tools, drags, clicks, wheel, keys, undo, redo,
# opening files and bodies, resizing and quitting, on one scene after another. A run is 40 to 119 actions; it fails where
# the program ends otherwise than it was asked to, or says anything on stderr, as the sanitizers do. runs.txt has a line
# for each: seed, scene, actions, how many bodies were open one after the other, seconds, exit code.
# With INCISE_SOAK_PRELOAD=LIBRARY the program alone has that library loaded first, and glibc checks its memory.
# usage: window_soak.sh BIN-FOLDER WORK-FOLDER SECONDS SEED [RUNS]
# It ends after SECONDS, or after RUNS runs where that comes first. A run that fails comes back with its seed and RUNS 1,
# as far as time allows; what it said and what was done are kept in WORK-FOLDER/run-SEED/.
set -euo pipefail
root=$(cd -- "$(dirname -- "${BASH_SOURCE[0]}")/../.." && pwd)
bin=$(cd -- "$1" && pwd)
mkdir -p -- "$2"
work=$(cd -- "$2" && pwd)
seconds=$3
seed=$4
most_runs=${5:-1000000}

say() { printf 'window_soak: %s\n' "$*" >&2; }
command -v Xvfb >/dev/null || { say "there is no Xvfb (package xvfb)"; exit 77; }
command -v xdotool >/dev/null || { say "there is no xdotool"; exit 77; }

# Leaks of the driver alone, by the names of its libraries.
export LSAN_OPTIONS="suppressions=$root/script/lib/window_leaks.txt:print_suppressions=0${LSAN_OPTIONS:+:$LSAN_OPTIONS}"

pid=
hand=
server=
end() {
  [ -z "$hand" ] || kill "$hand" 2>/dev/null || true
  [ -z "$pid" ] || kill "$pid" 2>/dev/null || true
  [ -z "$server" ] || kill "$server" 2>/dev/null || true
}
trap end EXIT

unset DISPLAY WAYLAND_DISPLAY XAUTHORITY
Xvfb -displayfd 3 -screen 0 1280x800x24 +extension GLX -nolisten tcp -noreset 3>"$work/display.txt" >/dev/null 2>&1 &
server=$!
answers() { # whether the server has a number and takes clients
  grep -qs '^[0-9][0-9]*$' "$work/display.txt" || return 1
  DISPLAY=:$(cat "$work/display.txt")
  export DISPLAY
  [ "$(xdotool getdisplaygeometry 2>/dev/null)" = "1280 800" ]
}
for ((i = 0; ; ++i)); do
  answers && break
  [ $i -lt 600 ] || { say "Xvfb does not answer"; exit 1; }
  sleep 0.1
done

pick() { # pick WORD...: one of them, into `picked`; a subshell would not move RANDOM on
  local words=("$@")
  picked=${words[RANDOM % ${#words[@]}]}
}
place() { # into `x` and `y`: mostly in the middle of the picture, where the body is
  if [ $((RANDOM % 5)) = 0 ]; then
    x=$((RANDOM % width)) y=$((RANDOM % height))
  else
    x=$((width / 4 + RANDOM % (width / 2))) y=$((height / 4 + RANDOM % (height / 2)))
  fi
}
tell() { printf '%s\n' "$*" >>actions.txt; } # tell ARGUMENT...: what xdotool is to do
drag() {
  local button steps i x0 y0 moves
  pick 1 1 1 1 3 2
  button=$picked
  steps=$((1 + RANDOM % 12))
  place
  x0=$x y0=$y
  place
  moves=(mousemove "$x0" "$y0" mousedown "$button")
  for ((i = 1; i <= steps; ++i)); do
    moves+=(mousemove $((x0 + (x - x0) * i / steps)) $((y0 + (y - y0) * i / steps)))
    [ $((RANDOM % 2)) != 0 ] || moves+=(sleep 0.02)
    [ $((RANDOM % 40)) != 0 ] || moves+=(key ctrl+z) # in the middle of a stroke
  done
  tell "${moves[@]}" mouseup "$button"
}
open_another() { # by the button of the bodies, then a card, which may be the list of files, then a line of that
  local cards_x cards_y
  # Whatever keys have hidden, the first panels are there then.
  tell key Escape key Tab
  if [ "$is_research" = 0 ]; then tell key Tab; fi
  is_research=0
  [ $((RANDOM % 3)) = 0 ] || tell mousemove $((width / 2 + 207)) $((height - 36)) click 1
  cards_x=$((width / 6 + RANDOM % (2 * width / 3))) cards_y=$((height - 75 - RANDOM % 85))
  if [ $((RANDOM % 3)) = 0 ]; then cards_x=$((width / 2 + (width < 1068 ? 251 : 370))) cards_y=$((height - 138)); fi
  tell mousemove "$cards_x" "$cards_y" sleep 0.05 click 1
  tell sleep 0.2 mousemove $((width / 2 - 100)) $((height / 2 - 140 + RANDOM % 150)) sleep 0.05 click 1
}
act() {
  case $((RANDOM % 17)) in
    0 | 1 | 2 | 3 | 4) drag ;;
    5) place; tell mousemove "$x" "$y" click 1 ;;
    6 | 7) pick 1 2 2 3 4 5 6 7 8 9 0 u j; tell key "$picked" ;;
    8) pick ctrl+z ctrl+z ctrl+z ctrl+shift+z; tell key "$picked" ;;
    9) pick 4 5; place; tell mousemove "$x" "$y" click "$picked" ;;
    10 | 11) pick w c x Page_Down Page_Up q t o b p h f plus minus Left Up period period n g i Return comma; tell key "$picked" ;;
    12) pick space space r v s ctrl+plus ctrl+minus Escape Tab ctrl+e; tell key "$picked"; [ "$picked" != Tab ] || is_research=$((1 - is_research)) ;;
    13) place; tell keydown shift mousemove "$x" "$y" mousedown 1 mousemove $((x + 40)) $((y + 20)) mouseup 1 keyup shift ;;
    14)
      [ $((RANDOM % 3)) = 0 ] || return 0
      width=$((320 + RANDOM % 900)) height=$((240 + RANDOM % 500))
      tell windowsize "$id" "$width" "$height"
      ;;
    15) tell sleep "0.$((RANDOM % 10))" ;;
    16) open_another ;;
  esac
  tell sleep 0.05 getwindowname "$id"
}
lay_out_files() { # what the list of files then offers: bodies, a scene, a recording, and what is none
  ln -s "$root/tests/recordings/cube.mesh" "$root/scenes/sim_cube.json" "$root/scenes/train_core.json" .
  ln -s "$root/tests/recordings/everything.jsonl" .
  head -c 300 "$root/tests/recordings/cube.mesh" >broken.mesh
  printf '{"name": 3}\n' >broken.json
}

scenes=("" "$root/scenes/sim_cube.json" "$root/scenes/train_skin.json" "$root/scenes/sim_skin.json")
[ ! -e "$root/models/bunny.mesh" ] || scenes+=("$root/models/bunny.mesh")
for recording in "$root"/tests/recordings/*.jsonl; do
  [ ! -e "$recording" ] || scenes+=("$recording")
done

worked() { awk '{ print $14 + $15 }' "/proc/$pid/stat" 2>/dev/null || echo 0; } # hundredths of a second

run() { # run SEED: one program, from start to end
  RANDOM=$1
  local folder=$work/run-$1 scene status=0 i actions=0 began=$SECONDS bodies is_research=0 quit_by
  rm -rf -- "$folder"
  mkdir -p -- "$folder"
  cd -- "$folder"
  lay_out_files
  pick "${scenes[@]}"
  scene=$picked
  pick 1280x720 1280x720 960x600 800x600 640x400
  width=${picked%x*} height=${picked#*x}
  env ${INCISE_SOAK_PRELOAD:+LD_PRELOAD="$INCISE_SOAK_PRELOAD" GLIBC_TUNABLES=glibc.malloc.check=3} \
    "$bin/incise-view" --size "${width}x$height" ${scene:+"$scene"} >told.txt 2>said.txt &
  pid=$!
  id=
  for ((i = 0; i < 600; ++i)); do
    id=$(xdotool search --onlyvisible --pid "$pid" 2>/dev/null | head -n 1 || true)
    [ -z "$id" ] || break
    kill -0 "$pid" 2>/dev/null || break
    sleep 0.1
  done
  if [ -n "$id" ]; then
    xdotool windowfocus "$id" 2>/dev/null || true
    for ((i = 0; i < 600; ++i)); do # until it shows its body
      [ "$(xdotool getwindowname "$id" 2>/dev/null)" = Incise ] && kill -0 "$pid" 2>/dev/null || break
      sleep 0.1
    done
    actions=$((40 + RANDOM % 80))
    for ((i = 0; i < actions; ++i)); do act; done
    # By one program: starting one for each action takes longer than the action.
    xdotool actions.txt >titles.txt 2>/dev/null &
    hand=$!
    while kill -0 "$hand" 2>/dev/null && kill -0 "$pid" 2>/dev/null; do sleep 0.2; done
    kill "$hand" 2>/dev/null || true
    wait "$hand" 2>/dev/null || true
    hand=
    # It may be busy; it takes the key once it is not. Half a minute is that of its own work: the machine may be busier.
    quit_by=$(($(worked) + 3000))
    for ((i = 0; i < 1200; ++i)); do
      kill -0 "$pid" 2>/dev/null && [ "$(worked)" -lt $quit_by ] || break
      xdotool key ctrl+q 2>/dev/null || true
      sleep 0.5
    done
  fi
  if kill -0 "$pid" 2>/dev/null; then
    kill -ABRT "$pid"
    printf 'it did not quit\n' >>said.txt
  fi
  wait "$pid" || status=$?
  pid=
  bodies=$(uniq titles.txt 2>/dev/null | grep -c . || true)
  cd -- "$work"
  printf 'seed %s: %s, %s actions, %s bodies, %s s, exit %s\n' "$1" "${scene##*/}" "$actions" "$bodies" \
    $((SECONDS - began)) "$status" >>runs.txt
  if [ "$status" != 0 ] || [ -s "$folder/said.txt" ] || [ -z "$id" ]; then
    say "seed $1 on '${scene:-no file}' ended with $status after $(cat "$folder"/actions.txt 2>/dev/null | wc -l) actions:"
    head -n 60 "$folder/said.txt" >&2
    return 1
  fi
  rm -rf -- "$folder"
}

runs=0
failed=0
while [ $SECONDS -lt "$seconds" ] && [ $runs -lt "$most_runs" ]; do
  run $((seed + runs)) || failed=$((failed + 1))
  runs=$((runs + 1))
done
say "$runs runs from seed $seed, $failed failed"
[ $failed = 0 ]
