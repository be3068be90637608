#!/bin/sh
# Measures psmrt on a machine with a GPU, within 8 minutes once it is built, and writes golden/hardware/ADAPTER.csv (of an
# adapter in software, which is no hardware, out/hardware/ADAPTER.csv):
# the device trials, the speeds of the kernel and of the CPU engine side by side, and where a step of the paper's settling
# grains spends its time.
#
#   report/hardware.sh [ADAPTER] [GB_PER_SECOND]
#
# ADAPTER: a part of its name, as `psmrt info` lists it; the fastest kind if it is left out or empty. (The device trials
# always take that one.)
# GB_PER_SECOND: the memory bandwidth of the card by its data sheet; shares of it are then written too.
# SIDE: cells along each edge for the speeds (256; a software adapter has time for 64). STEPS: of the settling scene (200).
set -eu
cd "$(dirname "$0")/.."
adapter=${1:-}
bandwidth=${2:-}
side=${SIDE:-256}
steps=${STEPS:-200}

cargo build --locked --release --workspace
PSMRT_REQUIRE_GPU=1 cargo test --locked --test device --no-run

scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
psmrt=target/release/psmrt
# The adapters, the fastest kind first, one a line, and of each its name.
adapters=$("$psmrt" info --json | sed 's/.*"adapters":\[//' | tr '}' '\n' | grep '"name"') || true
names=$(printf '%s\n' "$adapters" | sed -n 's/.*"name":"\([^"]*\)".*/\1/p')
fastest=$(printf '%s\n' "$names" | head -n 1)
name=$(printf '%s\n' "$names" | grep -i -F -- "$adapter" | head -n 1) || true
facts=$(printf '%s\n' "$adapters" | grep -F -- "\"name\":\"$name\"" | head -n 1) || true
field() { printf '%s\n' "$facts" | sed -n "s/.*\"$1\":\"\([^\"]*\)\".*/\1/p"; }
if [ -z "$name" ]; then
    echo "no adapter is called \"$adapter\"; psmrt info lists them" >&2
    exit 1
fi
slug=$(printf '%s' "$name" | tr '[:upper:]' '[:lower:]' | tr -c 'a-z0-9' '_' | sed 's/__*/_/g; s/_$//')
folder=golden/hardware
[ "$(field kind)" != software ] || folder=out/hardware
mkdir -p "$folder"
out=$folder/$slug.csv

echo "device trials of the kernel on $fastest" >&2
trials=failed
if PSMRT_REQUIRE_GPU=1 cargo test --locked --test device -- wgpu:: > "$scratch/trials.txt" 2>&1; then
    trials=passed
fi
count=$(sed -n 's/^test result: [^0-9]*\([0-9]*\) passed; \([0-9]*\) failed.*/\1 passed; \2 failed/p' "$scratch/trials.txt" | tail -n 1)

echo "speeds at $side^3 cells" >&2
target/release/validate speed --side "$side" --rounds 3 --no-oracle --wgpu "$name" \
    --threads "$(getconf _NPROCESSORS_ONLN)" --out "$scratch/speed.csv" > "$scratch/speed.txt"

echo "$steps steps of 12,000 settling grains" >&2
profiled() {
    engine=$1
    shift
    "$psmrt" run golden/cloud_settling/paper.toml --engine "$engine" "$@" --profile --json \
        --set stop.steps="$steps" --out "$scratch/$engine" > "$scratch/$engine.json"
}
profiled wgpu --adapter "$name"
profiled cpu_single

{
    echo "# $name ($(field kind), $(field backend); $(field driver)) beside the CPU engine on $(getconf _NPROCESSORS_ONLN) threads."
    echo "# Made by: report/hardware.sh, commit $(git rev-parse HEAD)$(git diff --quiet HEAD || echo ' with changes'), $(date -u +%Y-%m-%d)"
    echo "# what, on which engine and in which work; share: of $([ -n "$bandwidth" ] && echo "$bandwidth GB/s" || echo "a bandwidth that was not given")"
    echo "what,engine,work,value,unit,share"
    echo "device trials: $trials,wgpu,$(printf '%s' "$fastest" | tr ',' ' '),$count,,"
    grep -v '^#' "$scratch/speed.csv" | awk -F, -v bandwidth="$bandwidth" '
        NR > 1 && ($2 == "wgpu" || $2 ~ /^cpu/) {
            share = ""
            if ($2 == "wgpu" && bandwidth != "") share = sprintf("%.2f", $9 / bandwidth)
            if ($2 ~ /^cpu/) share = $8
            printf "speed,%s,%s,%s,million cell updates per second,%s\n", $2, $4, $5, share
        }'
    for engine in wgpu cpu_single; do
        tr ',{}' '\n\n\n' < "$scratch/$engine.json" |
            sed -n 's/^"\([a-z]*\)_seconds_per_step":\(.*\)$/profile of the settling grains,'"$engine"',\1,\2,s per step,/p'
    done
} > "$scratch/hardware.csv"
mv "$scratch/hardware.csv" "$out"
cat "$out"
[ "$trials" = passed ] || { tail -n 30 "$scratch/trials.txt" >&2; exit 1; }
