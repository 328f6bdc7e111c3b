#!/usr/bin/env bash
# Makes the pictures that the guides show; --help says more.
set -euo pipefail
source_dir=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
clatter=${CLATTER:-$source_dir/build/release/apps/clatter/clatter}

usage() {
  cat <<END
usage: scripts/gallery.sh [DIR]

Runs shipped configurations and draws the pictures that README.md and the guides show, as SVG, into DIR; default: configs.
The program is build/release/apps/clatter/clatter, or what CLATTER names.
END
}

case "${1-}" in
  -h | --help) usage; exit 0 ;;
  -*) echo "gallery.sh: unknown option '$1'; try --help" >&2; exit 2 ;;
esac
if (($# > 1)); then
  echo "gallery.sh: one directory at most; try --help" >&2
  exit 2
fi
if [[ ! -x $clatter ]]; then
  echo "gallery.sh: there is no program '$clatter'; build it with: cmake --preset release && cmake --build --preset release" >&2
  exit 2
fi
mkdir -p "${1:-$source_dir/configs}"
out=$(cd "${1:-$source_dir/configs}" && pwd)
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

draw() { # configuration, then options of plot.py
  "$clatter" run "$source_dir/configs/$1.toml" -o "$work/$1.h5" -q
  "$source_dir/scripts/plot.py" "$work/$1.h5" "${@:2}" --format svg -o "$out"
}

"$clatter" run "$source_dir/configs/fig22.toml" --set sweep.nu='linspace(0.7, 1.3, 121)' -o "$work/fig22.h5" -q
"$source_dir/scripts/plot.py" "$work/fig22.h5" --format svg -o "$out"
draw bifurcation --only section_x --size 7x4
draw poincare --only section --size 5x4
draw hysteresis --only v_max --xlim 0.95,1.25 --ylim 2,4.5 --size 5x3.5
draw family_R --only v_before --size 7x3.4
draw one_stop --only x_min,x_max --size 5x3.8
draw drive_si --only impact_power --size 5x3.5 --title "The paper's vibration drive in SI"
draw drill --only impact_power --size 5x3.8
draw bouncing_ball --only section_v --size 5x3.5
"$clatter" run "$source_dir/configs/bouncing_ball.toml" --set sweep.f='linspace(0.36, 1.5, 229)' --set time.window=200 \
  --set observe.section=0 --set observe.stability=false --set observe.impact_log=true -o "$work/bouncing_ball_phases.h5" -q
"$source_dir/scripts/plot.py" "$work/bouncing_ball_phases.h5" --only impact_phase --size 5x3.5 \
  --title 'Impacts of a ball on a shaken table' --format svg -o "$out"
draw ceiling --only impact_power --size 5x3.5
draw gear_rattle --only x_min,x_max,impact_power --size 7x3.5
draw harvester --only impact_power --size 5x3.8
for shape in square sine; do
  "$clatter" run "$source_dir/configs/square_drive.toml" --set machine.force_shape=$shape -o "$work/$shape.h5" -q
done
"$source_dir/scripts/plot.py" "$work"/{square,sine}.h5 --only impact_speed --size 6x3.8 --format svg -o "$work"
mv "$work/square+sine.svg" "$out/square_drive.svg"
"$clatter" run "$source_dir/configs/feeder.toml" -o "$work/feeder.h5" -q
"$clatter" run "$source_dir/configs/feeder.toml" --set machine.force='6 N' --set machine.phase='-90 deg' \
  --set machine.load='4.5 N' -o "$work/first_order.h5" -q
"$source_dir/scripts/plot.py" "$work"/{feeder,first_order}.h5 --only x_max --size 6x3.8 --format svg -o "$work"
mv "$work/feeder+first_order.svg" "$out/feeder.svg"
for R in 0.92 0.75; do
  "$clatter" run "$source_dir/configs/measured_stop.toml" --set machine.R=$R -o "$work/$R.h5" -q
done
"$clatter" run "$source_dir/configs/measured_stop.toml" -o "$work/measured_stop.h5" -q
"$source_dir/scripts/plot.py" "$work"/{measured_stop,0.92,0.75}.h5 --only time_to_rest --size 5x3.8 --format svg -o "$work"
mv "$work/measured_stop+0.92+0.75.svg" "$out/measured_stop.svg"
draw soft_bumper --only contact_force_max --log xy --size 5x3.5
draw slide --only x_max --ylim '0 mm, 6.6 mm' --size 5x3.8
"$clatter" run "$source_dir/configs/slide.toml" --set machine.friction='12 N' --set machine.frequency='4 Hz' \
  --set observe.trajectory=1000 -o "$work/slide_sticks.h5" -q
"$source_dir/scripts/plot.py" "$work/slide_sticks.h5" --only trajectory --size 7x5 --title 'Slide that sticks at each turn' \
  --format svg -o "$out"
draw impact_damper --only x_max --size 5x3.8
draw energy_sink --only x_max,impacts_per_period --size 7x3.5
"$clatter" run "$source_dir/configs/energy_sink.toml" --set scene.f=0.009 --set observe.trajectory=1000 \
  --set observe.impact_log=true --set observe.stability=false -o "$work/energy_sink_motion.h5" -q
"$source_dir/scripts/plot.py" "$work/energy_sink_motion.h5" --only trajectory --size 7x5 \
  --title 'Both masses of an energy sink' --format svg -o "$out"
draw energy_sink_basin --only attractor --size 6x3.8
draw soft_history --only trajectory --size 7x5
draw basins --only attractor --size 6x3.8
draw zones --size 8x4.2
for frame in relative absolute; do
  "$clatter" run "$source_dir/configs/shaken_stops.toml" --set observe.frame=$frame -o "$work/$frame.h5" -q
done
"$source_dir/scripts/plot.py" "$work"/{relative,absolute}.h5 --only x_min,x_max --size 5x3.8 --format svg -o "$work"
mv "$work/relative+absolute.svg" "$out/shaken_stops.svg"
draw regimes --only word --size 6x4
for xs in 0.45 1.0 1.6; do
  for curve in fold symmetry\ breaking graze; do
    case "$xs $curve" in 0.45\ fold | 0.45\ graze) continue ;; esac # too many of them for a picture
    code=0
    "$clatter" branch "$source_dir/configs/curves.toml" --set scene.xs="$xs" --set branch.curve="$curve" -q \
      -o "$work/$xs ${curve%% *}.h5" > /dev/null 2> "$work/failures" || code=$?
    ((code <= 1)) || { cat "$work/failures" >&2; exit "$code"; } # 1: some end in a point of higher order
  done
done
"$source_dir/scripts/plot.py" "$work/regimes.h5" "$work"/?.*\ *.h5 --size 6x4.6 --format svg -o "$work"
mv "$work"/regimes+*.svg "$out/curves.svg"
"$clatter" branch "$source_dir/configs/branch.toml" -o "$work/branch.h5" -q > /dev/null
"$source_dir/scripts/plot.py" "$work/branch.h5" --only impact_speed --size 7x4 --format svg -o "$out"
"$clatter" branch "$source_dir/configs/soft_branch.toml" -o "$work/soft_branch.h5" -q > /dev/null
"$source_dir/scripts/plot.py" "$work/soft_branch.h5" --only v_max --size 7x4 --format svg -o "$out"
"$clatter" branch "$source_dir/configs/energy_sink_branch.toml" -o "$work/energy_sink_branch.h5" -q > /dev/null
"$source_dir/scripts/plot.py" "$work/energy_sink_branch.h5" --only x_max,impact_speed --size 7x5.5 --format svg -o "$out"
optimal() { # name, then settings of the start
  "$clatter" branch "$source_dir/configs/optimal.toml" -o "$work/$1.h5" -q "${@:2}" > /dev/null
}
"$clatter" run "$source_dir/configs/optimal_zones.toml" -o "$work/shares.h5" -q
optimal one
optimal two --set scene.nu=4.95 --set scene.x0=-0.2575 --set scene.v0=0.9394 --set branch.period=2
optimal three --set scene.nu=7 --set scene.x0=0.25 --set scene.v0=-2.5
"$source_dir/scripts/plot.py" "$work"/{shares,one,two,three}.h5 --only impact_speed --backbone --size 8x5 --format svg \
  -o "$work"
mv "$work/shares+one+two+three.svg" "$out/optimal.svg"
