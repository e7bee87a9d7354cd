# The study's cases: poured and settled side by side, measured. Sourced from the repository's root by
# run and report.
#
# A case is the words "LAMBDA LIMITS SEED", LIMITS being study (its limits on the angular velocity)
# or none. Its folder holds the decks it was run with, logs, dumps and restarts.

seeds=(86028121 49979687 67867967 104395301 122949823 141650939 160481183 179424673 198491317 217645177)
declare -A vessel_radius=([10]=0.105 [20]=0.205 [30]=0.305)
total_time=10   # s; in.rods counts 50000 steps a second

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

# The decks, the plug-in and the time that make a result.
made_by() { { cat input/in.* build/release/libspherocylinder.so; echo "$total_time"; } | sha256sum | cut -d' ' -f1; }

# One case: fill, settle, in its own folder with its own copy of the decks. The wall time in seconds
# goes to a file, which also says that the case is finished.
run_case() {
  local root=$PWD folder=$1 lambda=$2 limits=$3 seed=$4 lmp='' stage
  local variables=(-var lambda "$lambda" -var seed "$seed" -var total_time "$total_time")
  [ "$limits" = study ] || variables+=(-var limit_fill 0 -var limit_settle 0)
  local begin=$SECONDS
  trap '[ -z "$lmp" ] || kill "$lmp" 2>/dev/null; exit 1' TERM INT
  cp input/in.* "$folder"
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

# Steps done so far by the case in a folder.
steps_done() {
  local step
  step=$(awk '$1 ~ /^[0-9]+$/ && NF == 9 { s = $1 } END { print s + 0 }' \
    "$1"/log.fill "$1"/log.settle 2>/dev/null) || step=0
  echo "${step:-0}"
}

show_progress() {  # OUT BEGAN CASE...
  local out=$1 began=$2 done_steps=0 c left='...' text
  shift 2
  local all_steps=$(($# * 50000 * total_time))
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
    $# $((100 * done_steps / all_steps)) $((elapsed / 60)) $((elapsed % 60)) "$left")
  if [ -t 1 ]; then printf '\r%s   ' "$text"; else echo "$text"; fi
}

# run_cases OUT JOBS CASE...: runs those whose folder in OUT holds no finished run, JOBS at a time.
# After each case the caller's function `finished FOLDER LAMBDA LIMITS SEED` is called, for a kept
# one at once. A case that fails is named, the others go on; then the result is 1.
run_cases() {
  local out=$1 jobs=$2 maker c folder r pid i began=$SECONDS last_shown=-1000 interval=2
  shift 2
  local to_run=() pending=() running=() still=() failed=()
  [ -t 1 ] || interval=30
  maker=$(made_by)
  for c in "$@"; do
    # shellcheck disable=SC2086
    folder=$out/$(name_of $c)
    if [ -e "$folder/wall_seconds" ]; then
      if [ "$(cat "$folder/made_by")" != "$maker" ]; then
        echo "${0##*/}: $folder was made with other decks or another plug-in: move it away or give another folder" >&2
        return 2
      fi
      echo "${0##*/}: $(name_of $c) is finished, kept"
      # shellcheck disable=SC2086
      finished "$folder" $c
    else
      rm -rf "$folder"; mkdir -p "$folder"
      echo "$maker" >"$folder/made_by"
      to_run+=("$c")
    fi
  done
  trap 'kill $(jobs -p) 2>/dev/null || true; wait' EXIT
  pending=("${to_run[@]}")
  while [ ${#pending[@]} -gt 0 ] || [ ${#running[@]} -gt 0 ]; do
    while [ ${#pending[@]} -gt 0 ] && [ ${#running[@]} -lt "$jobs" ]; do
      c=${pending[0]}; pending=("${pending[@]:1}")
      # shellcheck disable=SC2086
      run_case "$out/$(name_of $c)" $c &
      running+=("$! $c")
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
      show_progress "$out" "$began" "${to_run[@]}"; last_shown=$SECONDS
    fi
  done
  trap - EXIT
  if [ -t 1 ] && [ ${#to_run[@]} -gt 0 ]; then echo; fi
  [ ${#failed[@]} -eq 0 ] && return 0
  echo "${0##*/}: failed: ${failed[*]}" >&2
  return 1
}

# A named column of a one-row CSV.
column() { awk -F, -v name="$2" 'NR==1 { for (i = 1; i <= NF; i++) if ($i == name) c = i } NR==2 { print $c }' "$1"; }

measures=vf_whole,vf_inner,vf_theory,mean_elevation_deg,mean_sin_gamma,nematic_order,contacts_per_rod,mean_overlap_over_diameter,largest_overlap_over_diameter,momentary_overlap_over_diameter,energy_J,time_s

# measure_case FOLDER LAMBDA: prints the values of `measures`; leaves packing.csv, orientation.csv and
# order.csv in the folder.
measure_case() {
  local folder=$1 lambda=$2 last peak energy contacts mean_overlap largest time
  build/release/rod_packing "$folder/dump.settle" --vessel-radius "${vessel_radius[$lambda]}" \
    --csv "$folder/packing.csv" >"$folder/packing.txt"
  build/release/rod_orientation "$folder/dump.settle" --bins 12 --csv "$folder/orientation.csv" \
    --summary-csv "$folder/order.csv" >"$folder/orientation.txt"
  # step time atoms energy contacts mean_overlap largest_overlap momentary_overlap cpu
  last=$(awk '$1 ~ /^[0-9]+$/ && NF == 9 { l = $4","$5","$6","$7","$2 } END { print l }' "$folder/log.settle")
  peak=$(awk '$1 ~ /^[0-9]+$/ && NF == 9 && $8 > p { p = $8 } END { print p }' "$folder/log.fill" "$folder/log.settle")
  IFS=, read -r energy contacts mean_overlap largest time <<<"$last"
  echo "$(column "$folder/packing.csv" vf_whole),$(column "$folder/packing.csv" vf_inner),$(column "$folder/packing.csv" vf_parkhouse_kelly),$(column "$folder/packing.csv" mean_elevation_deg),$(column "$folder/packing.csv" mean_sin_gamma),$(column "$folder/order.csv" nematic_order),$contacts,$mean_overlap,$largest,$peak,$energy,$time"
}
