#!/bin/sh
# SPDX-License-Identifier: GPL-2.0-or-later
# Runs test_decks and writes what it measured into the verification table of tests/README.md.
#   tests/decks/verification_table.sh build/release
set -eu
build=${1:?usage: verification_table.sh BUILD_FOLDER}
readme=$(dirname "$0")/../README.md
table=$(mktemp)
output=$(mktemp)
trap 'rm -f "$table" "$output" "$readme.new"' EXIT

# The table tells of a run in which every test passed, or of none.
"$build/test_decks" > "$output" || { grep FAILED "$output" >&2; exit 1; }

{
  echo '| case | source of the expected value | tolerance | measured error |'
  echo '|---|---|---|---|'
  # One line a claim: the largest error of all its runs (ranks, restarts, models).
  awk -F ' [|] ' '
    sub(/^\[ MEASURED \] /, "") {
      if (!($1 in worst)) { order[++n] = $1; source[$1] = $2; tolerance[$1] = $3; worst[$1] = $4 }
      if ($4 + 0 > worst[$1] + 0) worst[$1] = $4
    }
    END {
      for (i = 1; i <= n; i++)
        printf "| %s | %s | %s | %s |\n", order[i], source[order[i]], tolerance[order[i]], worst[order[i]]
    }' "$output"
} > "$table"

awk -v table="$table" '
  /^<!-- table begins/ { print; while ((getline line < table) > 0) print line; skip = 1; next }
  /^<!-- table ends/ { skip = 0 }
  !skip { print }' "$readme" > "$readme.new"
# Overwritten in place, so that the file keeps its mode.
cat "$readme.new" > "$readme"
