# The study's cases: poured and settled side by side, measured. Sourced from the repository's root by
# run and report.
#
# A case is the words "LAMBDA LIMITS SEED", LIMITS being study (its limits on the angular velocity)
# or none. Its folder holds the decks it was run with, logs, dumps and restarts.

# A command that fails within $( ) ends the script too.
shopt -s inherit_errexit

seeds=(86028121 49979687 67867967 104395301 122949823 141650939 160481183 179424673 198491317 217645177)
declare -A vessel_radius=([10]=0.105 [20]=0.205 [30]=0.305)
total_time=10   # s; in.rods counts 50000 steps a second

# What runs, measures and draws them, as targets of the build: without the tests.
programs=(lmp spherocylinder rod_packing rod_orientation rod_render)

# Whether finished runs are computed again all the same.
compute_anew=no

name_of() { echo "lambda$1_limits_$2_seed$3"; }

# cases LAMBDAS NUMBER_OF_SEEDS: one case a line, the first seed of all lambdas first.
cases() {
  local k lambda limits
  for ((k = 0; k < $2; k++)); do
    for lambda in $1; do
      for limits in study none; do echo "$lambda $limits ${seeds[k]}"; done
    done
  done
}

# The decks; in.case is what a run by hand in their folder leaves there.
decks() { find input -name 'in.*' ! -name in.case | LC_ALL=C sort; }

# The decks, the plug-in and the time that make a result.
made_by() {
  { decks | xargs cat; cat build/release/libspherocylinder.so; echo "$total_time"; } | sha256sum | cut -d' ' -f1
}

# Keeps a folder to this script until it and all it has started have ended: two at once would remove
# each other's runs.
lock_folder() {
  local lock
  exec {lock}<"$1"
  flock --nonblock "$lock" || die "another ${0##*/} works in $1: wait until it has ended"
}

# One case: fill, settle, in its own folder with its own copy of the decks. The wall time in seconds
# goes to a file, which also says that the case is finished.
run_case() {
  local root=$PWD folder=$1 lambda=$2 limits=$3 seed=$4 lmp='' stage
  local variables=(-var lambda "$lambda" -var seed "$seed" -var total_time "$total_time")
  [ "$limits" = study ] || variables+=(-var limit_fill 0 -var limit_settle 0)
  local begin=$SECONDS
  trap '[ -z "$lmp" ] || { kill "$lmp"; wait "$lmp"; } 2>/dev/null; exit 1' TERM INT
  decks | xargs cp -t "$folder"
  cd "$folder"
  # Runs side by side: Open MPI's single ranks would share, and remove, one session folder.
  mkdir -p mpi
  export OMPI_MCA_ess_singleton_isolated=1 OMPI_MCA_orte_tmpdir_base=$PWD/mpi
  for stage in fill settle; do
    "$root/build/release/lmp" -in in.$stage "${variables[@]}" -log log.$stage \
      >screen.$stage 2>&1 &
    lmp=$!
    wait "$lmp" || return 1
    lmp=
    # A run stopped by a signal ends with exit code 0 but without its last command.
    [ -e restart.$stage ] || return 1
  done
  rm -rf mpi
  echo $((SECONDS - begin)) >wall_seconds
}

# log_columns FILE NAME...: these columns of all lines of a log's tables, with commas between.
# LIGGGHTS calls all values of a compute alike: NAME:2of4 is the second of four columns NAME.
log_columns() {
  local file=$1
  shift
  awk -v file="$file" -v program="${0##*/}" -v names="$*" '
    function refuse(text) { print program ": " file " " text >"/dev/stderr"; refused = 1; exit 1 }
    BEGIN { wanted = split(names, name, " ") }
    $1 == "Step" {
      split("", all); split("", at); split("", nth)
      for (i = 1; i <= NF; i++) all[$i]++
      for (i = 1; i <= NF; i++) at[all[$i] == 1 ? $i : $i ":" ++nth[$i] "of" all[$i]] = i
      for (k = 1; k <= wanted; k++) if (!(name[k] in at)) {
        $1 = $1
        refuse("has no column " name[k] " (its columns are: " $0 ")") }
      width = NF; next }
    /^Loop time/ { width = 0 }
    width && NF == width && $1 ~ /^[0-9]+$/ {
      lines++
      for (k = 1; k <= wanted; k++) printf "%s%s", $(at[name[k]]), k < wanted ? "," : "\n" }
    END { if (!refused && !lines) refuse("has no table") }' "$file"
}

# Steps done so far by the case in a folder.
steps_done() {
  local stage step=0
  for stage in fill settle; do
    step=$(log_columns "$1/log.$stage" Step 2>/dev/null | tail -n 1 | grep . || echo "$step")
  done
  echo "$step"
}

show_progress() {  # OUT BEGAN NUMBER_OF_CASES STARTED_CASE...
  local out=$1 began=$2 number=$3 done_steps=0 c left='...' text
  shift 3
  local all_steps=$((number * 50000 * total_time))
  for c in "$@"; do
    # shellcheck disable=SC2086
    done_steps=$((done_steps + $(steps_done "$out/$(name_of $c)")))
  done
  local elapsed=$((SECONDS - began))
  if [ "$done_steps" -gt 0 ] && [ "$elapsed" -gt 5 ]; then
    left=$(((all_steps - done_steps) * elapsed / done_steps))
    left=$(printf '%d:%02d' $((left / 60)) $((left % 60)))
  fi
  text=$(printf '%s: %d cases, %d %% of the steps, %d:%02d min so far, %s left' "${0##*/}" \
    "$number" $((100 * done_steps / all_steps)) $((elapsed / 60)) $((elapsed % 60)) "$left")
  if [ -t 1 ]; then printf '\r%s   ' "$text"; else echo "$text"; fi
}

# run_cases OUT JOBS CASE...: runs those whose folder in OUT holds no finished run, or all to compute
# them anew, JOBS at a time. What a folder held stays there until its own run starts.
# After each case the caller's function `finished FOLDER LAMBDA LIMITS SEED` is called, for a kept
# one at once. A case that fails is named, the others go on; then the result is 1.
run_cases() {
  local out=$1 jobs=$2 maker c folder r pid i began=$SECONDS last_shown=-1000 interval=2
  shift 2
  local pending=() started=() running=() still=() failed=() number
  [ -t 1 ] || interval=30
  maker=$(made_by)
  for c in "$@"; do
    # shellcheck disable=SC2086
    folder=$out/$(name_of $c)
    if [ $compute_anew = no ] && [ -e "$folder/wall_seconds" ]; then
      if [ "$(cat "$folder/made_by")" != "$maker" ]; then
        echo "${0##*/}: $folder was made with other decks or another plug-in: move it away or give another folder" >&2
        return 2
      fi
      echo "${0##*/}: $(name_of $c) is finished, kept"
      # shellcheck disable=SC2086
      finished "$folder" $c
    else
      pending+=("$c")
    fi
  done
  trap 'kill $(jobs -p) 2>/dev/null || true; wait' EXIT
  number=${#pending[@]}
  while [ ${#pending[@]} -gt 0 ] || [ ${#running[@]} -gt 0 ]; do
    while [ ${#pending[@]} -gt 0 ] && [ ${#running[@]} -lt "$jobs" ]; do
      c=${pending[0]}; pending=("${pending[@]:1}")
      # shellcheck disable=SC2086
      folder=$out/$(name_of $c)
      rm -rf "$folder"; mkdir -p "$folder"
      echo "$maker" >"$folder/made_by"
      # shellcheck disable=SC2086
      run_case "$folder" $c &
      running+=("$! $c"); started+=("$c")
    done
    sleep 1
    still=()
    for r in "${running[@]}"; do
      pid=${r%% *}; c=${r#* }
      if kill -0 "$pid" 2>/dev/null; then still+=("$r"); continue; fi
      # shellcheck disable=SC2086
      folder=$out/$(name_of $c)
      if wait "$pid"; then
        # shellcheck disable=SC2086
        finished "$folder" $c
        continue
      fi
      failed+=("$(basename "$folder")")
      { echo; echo "${0##*/}: $(basename "$folder") failed; the end of its log:"
        tail -n 5 "$folder"/screen.*; } >&2
    done
    running=("${still[@]+"${still[@]}"}")
    if [ $((SECONDS - last_shown)) -ge $interval ]; then
      show_progress "$out" "$began" "$number" "${started[@]}"; last_shown=$SECONDS
    fi
  done
  trap - EXIT
  if [ -t 1 ] && [ "$number" -gt 0 ]; then echo; fi
  [ ${#failed[@]} -eq 0 ] && return 0
  echo "${0##*/}: failed: ${failed[*]}" >&2
  return 1
}

# columns FILE NAME...: the named columns of a CSV file of one row, with commas between. Of FILE -,
# which is stdin, messages say what $called says.
columns() {
  local file=$1 name=$1
  shift
  [ "$file" != - ] || name=$called
  awk -F, -v file="$name" -v program="${0##*/}" -v names="$*" '
    function refuse(text) { print program ": " file " " text >"/dev/stderr"; refused = 1; exit 1 }
    NR == 1 {
      for (i = 1; i <= NF; i++) at[$i] = i
      wanted = split(names, name, " ")
      for (k = 1; k <= wanted; k++) if (!(name[k] in at)) refuse("has no column " name[k]) }
    NR == 2 {
      for (k = 1; k <= wanted; k++) {
        if ($(at[name[k]]) == "") refuse("has no value of " name[k])
        row = row (k == 1 ? "" : ",") $(at[name[k]]) } }
    END {
      if (!refused && NR != 2) refuse("must have one row below its header (got " (NR ? NR - 1 : 0) ")")
      if (!refused) print row }' "$file"
}

# What measure_case prints: first what the programs measure, then log_values.
measures=vf_whole,vf_inner,vf_theory,vf_random_contacts,mean_elevation_deg,mean_sin_gamma,nematic_order
measures+=,contacts_per_rod,mean_overlap_over_diameter,largest_overlap_over_diameter
measures+=,momentary_overlap_over_diameter,energy_J,time_s

# log_values FOLDER: the last six of `measures`.
log_values() {
  local fill settle peak
  fill=$(log_columns "$1/log.fill" contacts:4of4) || return
  settle=$(log_columns "$1/log.settle" contacts:4of4) || return
  peak=$(printf '%s\n' "$fill" "$settle" | LC_ALL=C sort -g | tail -n 1)
  log_columns "$1/log.settle" contacts:1of4 contacts:2of4 contacts:3of4 energy time | tail -n 1 |
    awk -F, -v peak="$peak" '{ print $1 "," $2 "," $3 "," peak "," $4 "," $5 }'
}

# measure_case FOLDER LAMBDA: prints the values of `measures`; leaves packing.csv, orientation.csv and
# order.csv in the folder.
measure_case() {
  local folder=$1 packing order from_log
  build/release/rod_packing "$folder/dump.settle" --vessel-radius "${vessel_radius[$2]}" \
    --csv "$folder/packing.csv" >"$folder/packing.txt"
  build/release/rod_orientation "$folder/dump.settle" --bins 12 --csv "$folder/orientation.csv" \
    --summary-csv "$folder/order.csv" >"$folder/orientation.txt"
  packing=$(columns "$folder/packing.csv" vf_whole vf_inner vf_parkhouse_kelly vf_random_contact_measured \
    mean_elevation_deg mean_sin_gamma)
  order=$(columns "$folder/order.csv" nematic_order)
  from_log=$(log_values "$folder")
  echo "$packing,$order,$from_log"
}
