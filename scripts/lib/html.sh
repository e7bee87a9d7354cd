# The report as one HTML file. Sourced by report, whose variables it reads.

# Text for HTML.
escaped() { sed 's/&/\&amp;/g; s/</\&lt;/g; s/>/\&gt;/g'; }

# image FILE TEXT: the picture itself in the page.
image() { printf '<img alt="%s" src="data:image/png;base64,%s">\n' "$2" "$(base64 -w0 "$1")"; }

# Tab-separated lines, the first with headings, to a table.
table() {
  escaped | awk -F'\t' 'BEGIN { print "<table>" }
    { cell = NR == 1 ? "th" : "td"; printf "<tr>"
      for (i = 1; i <= NF; i++) printf "<%s>%s</%s>", cell, $i, cell
      print "</tr>" }
    END { print "</table>" }'
}

# Time modelled at the n-th picture of the filling, of which the last is that of the settled bed.
time_of_snapshot() { awk "BEGIN { print ${snapshots[$1 - 1]:-$total_time * 50000} / 50000 }"; }

# Means over the beds of each kind with standard errors (of one bed: none).
table_of_means() {
  awk -F, '
    NR == 1 { for (i = 1; i <= NF; i++) at[$i] = i; next }
    { kind = $1 "\t" ($2 == "study" ? "of the study" : "none")
      if (!(kind in n)) order[++kinds] = kind
      k = ++n[kind]
      for (name in at) value[kind, name, k] = $(at[name]) }
    function mean(kind, name,   k, sum) {
      for (k = 1; k <= n[kind]; k++) sum += value[kind, name, k]
      return sum / n[kind] }
    function with_error(kind, name, format,   k, m, sum) {
      m = mean(kind, name)
      for (k = 1; k <= n[kind]; k++) sum += (value[kind, name, k] - m) ^ 2
      if (n[kind] == 1) return sprintf(format, m)
      return sprintf(format " ± " format, m, sqrt(sum / n[kind] / (n[kind] - 1))) }
    function largest(kind, name,   k, m) {
      for (k = 1; k <= n[kind]; k++) if (value[kind, name, k] + 0 > m) m = value[kind, name, k] + 0
      return m }
    END {
      print "λ\tlimits on ω\tbeds\tV_f inner cylinder\tV_f whole vessel\t2 ln λ/λ\trandom contacts\televation (°)\tnematic order\tcontacts a rod\tlargest overlap / D\tmost energy left (J)"
      for (i = 1; i <= kinds; i++) {
        kind = order[i]
        printf "%s\t%d\t%s\t%s\t%.4f\t%s\t%s\t%s\t%s\t%.4f\t%.1e\n", kind, n[kind],
          with_error(kind, "vf_inner", "%.4f"), with_error(kind, "vf_whole", "%.4f"),
          mean(kind, "vf_theory"), with_error(kind, "vf_random_contacts", "%.4f"),
          with_error(kind, "mean_elevation_deg", "%.1f"), with_error(kind, "nematic_order", "%.3f"),
          with_error(kind, "contacts_per_rod", "%.2f"),
          largest(kind, "largest_overlap_over_diameter"), largest(kind, "energy_J") } }' "$chosen" | table
}

table_of_beds() {
  awk -F, '
    NR == 1 { for (i = 1; i <= NF; i++) at[$i] = i
      print "λ\tlimits on ω\tseed\tV_f inner\tV_f whole\trandom contacts\televation (°)\t⟨|sin γ|⟩\tcontacts a rod\tmean overlap / D\tlargest overlap / D\tlargest on impact / D\tenergy left (J)\tmade from\tmeasured by"; next }
    { printf "%s\t%s\t%s\t%.4f\t%.4f\t%.4f\t%.2f\t%.4f\t%.2f\t%.5f\t%.4f\t%.3f\t%.1e\t%s\t%s\n", $1,
        $2 == "study" ? "of the study" : "none", $3, $(at["vf_inner"]), $(at["vf_whole"]),
        $(at["vf_random_contacts"]), $(at["mean_elevation_deg"]), $(at["mean_sin_gamma"]), $(at["contacts_per_rod"]),
        $(at["mean_overlap_over_diameter"]), $(at["largest_overlap_over_diameter"]),
        $(at["momentary_overlap_over_diameter"]), $(at["energy_J"]), $(at["sources"]), $(at["measured_by"]) }' "$chosen" | table
}

# The variables of in.rods with their defaults, and what this report sets.
table_of_settings() {
  { printf 'variable\tvalue\n'
    printf 'lambda, rods, vessel_diameter\t10: 500, 0.21 m; 20: 700, 0.41 m; 30: 700, 0.61 m\n'
    awk '$1 == "variable" && $3 == "index" && $4 + 0 != 0 && $2 != "lambda" && $2 != "seed" && $2 != "total_time" { print $2 "\t" $4 }' input/in.rods
    printf 'total_time\t%s\n' "$total_time"
    printf 'limit_fill, limit_settle without limits\t0, 0\n'
    printf 'seed\t%s\n' "${seeds[*]:0:$number_of_seeds}"; } | table
}

# Published values: label, lambda, V_f, whether read in the source, source.
table_of_literature() {
  awk '
    # Fields of a line, commas within double quotes left in place; their number.
    function fields_of(line, field,   i, n, c, quoted) {
      n = 1; field[1] = ""
      for (i = 1; i <= length(line); i++) {
        c = substr(line, i, 1)
        if (c == "\"") quoted = !quoted
        else if (c == "," && !quoted) field[++n] = ""
        else field[n] = field[n] c }
      return n }
    /^#/ { next }
    { n = fields_of($0, f)
      if (!header++) { for (i = 1; i <= n; i++) at[f[i]] = i; print "λ\tV_f\tkind\tread in its source\tsource"; next }
      vf = f[at["vf"]] (f[at["vf_error"]] == "" ? "" : " ± " f[at["vf_error"]])
      print f[at["lambda"]] "\t" vf "\t" f[at["kind"]] "\t" f[at["checked"]] "\t" f[at["source"]] }' \
    "$literature" | table
}

# The commands as they can be pasted, from the repository's root.
commands() {
  local n step i time='' no_limits="-var limit_fill 0 -var limit_settle 0" names_typed=''
  local where=${results#"$PWD"/} bed="dump.settle --vessel-radius ${vessel_radius[$shown_lambda]} --timestep 2e-5"
  [ "$total_time" = 10 ] || time=" -var total_time $total_time"
  for ((i = 1; i < ${#names[@]}; i += 2)); do names_typed+=" --name '${names[i]}'"; done
  {
    cat <<COMMANDS
export PATH="\$PWD/build/release:\$PATH"
mkdir -p build/one_bed
cp input/in.* build/one_bed
cd build/one_bed

# one bed; with the study's limits: without -var limit_fill 0 -var limit_settle 0
lmp -in in.fill   -var lambda $shown_lambda -var seed $shown_seed$time $no_limits
lmp -in in.settle -var lambda $shown_lambda -var seed $shown_seed$time $no_limits
rod_packing     dump.settle --vessel-radius ${vessel_radius[$shown_lambda]} --csv packing.csv
rod_orientation dump.settle --bins 12 --csv orientation.csv --summary-csv order.csv

# figures 1 and 2
COMMANDS
    for ((n = 1; n <= ${#snapshots[@]}; n++)); do
      echo "rod_render ${bed/settle/fill} --frame ${snapshots[n - 1]} ${snapshot_style[*]} --out figure1_$n.png"
    done
    cat <<COMMANDS
rod_render $bed ${snapshot_style[*]} --out figure1_$n.png
rod_render $bed ${bed_style[*]} --out figure2.png
rod_render $bed ${bed_style[*]} ${cut_style[*]} --out figure2_cut.png

# figures 3 and 4 of this bed alone
rod_plot packing packing.csv --name '=this bed' --literature ../../$literature --out figure3.svg
rod_plot orientation orientation.csv --name '=this bed' --out figure4.svg

# figures 3 and 4 of all beds
cd ../..
rod_plot packing $where/beds.csv --by limits$names_typed --literature $literature --out build/one_bed/figure3_all.svg
rod_plot orientation $where/elevation.csv --by lambda --panels limits$names_typed --out build/one_bed/figure4_all.svg
COMMANDS
  } | escaped
}

write_report() {
  local n mode text beds_each over error_bars means errors_of_figure4 rods
  if [ "$number_of_seeds" = 1 ]; then
    beds_each="one bed of each kind" over="one bed of each kind" error_bars= means="One bed of each kind."
    errors_of_figure4="One bed of each kind; error bars are those of its counts." rods="500 rods"
  else
    beds_each="$number_of_seeds beds of each kind, which differ in their seed"
    over="mean and standard error over $number_of_seeds beds"
    error_bars="; error bars shorter than a symbol are hidden by it"
    means="Means over beds ± standard error."
    errors_of_figure4="Points and error bars: $over."
    rods="$number_of_seeds beds of 500 rods"
  fi
  cat <<'HTML'
<!DOCTYPE html>
<html lang="en">
<head>
<meta charset="utf-8">
<meta name="viewport" content="width=device-width, initial-scale=1">
<title>Packing of sphero-cylinders: figures and tables</title>
<style>
body { font: 16px/1.5 "Helvetica Neue", Arial, sans-serif; color: #1a1a1a; max-width: 1150px; margin: 2em auto; padding: 0 1em; }
h1 { font-size: 1.7em; } h2 { font-size: 1.25em; margin-top: 2.2em; border-bottom: 1px solid #ccc; }
figure { margin: 1.5em 0; } figcaption { color: #444; font-size: 0.93em; max-width: 60em; }
img { max-width: 100%; height: auto; } .row { display: flex; gap: 0.5em; overflow-x: auto; } .row > * { flex: 1; min-width: 150px; text-align: center; }
.pair { display: flex; flex-wrap: wrap; gap: 0.5em; } .pair > * { flex: 1; min-width: min(100%, 330px); text-align: center; }
.wide { overflow-x: auto; }
table { border-collapse: collapse; font-size: 0.86em; font-variant-numeric: tabular-nums; }
th, td { padding: 0.25em 0.7em; border-bottom: 1px solid #ddd; text-align: left; vertical-align: top; } th { border-bottom: 2px solid #888; }
pre { background: #f5f5f5; padding: 0.8em; overflow-x: auto; font-size: 0.85em; }
.notice { background: #fff3cd; border: 1px solid #e0b400; padding: 0.7em 1em; }
</style>
</head>
<body>
<h1>Packing of sphero-cylinders of aspect ratio 10, 20 and 30</h1>
HTML
  [ $quick = no ] || cat <<HTML
<p class="notice"><b>This is the quick version</b>: $beds_each and $total_time s modelled, where the study has 10 s.
There are no error bars over beds, and beds with the study's limits are still settling. <code>scripts/report</code> makes the full one.</p>
HTML
  for text in "${notes[@]}"; do
    echo "<p class=\"notice\">$(escaped <<<"$text")</p>"
  done
  cat <<HTML
<p>Rods of diameter 0.01 m are placed at random over the height of an upright cylindrical vessel, 10 m, and fall all together.
Here: $beds_each, with the study's limits on the angular velocity ω
(4π rad/s while they fall, 0.2π rad/s while they settle) and with none. λ is the total length over the diameter.</p>

<h2>Volume fractions and orientation</h2>
<div class="wide">
$(table_of_means)
</div>
<p>$means <i>Inner cylinder</i>: of half the volume of the bed, concentric.
<i>Whole vessel</i>: up to the centre of the highest rod. <i>2 ln λ/λ</i>: Parkhouse and Kelly (1995).
<i>Random contacts</i>: the random contact equation with 5.25 contacts counted on each rod (Desmond and Franklin 2006), at the
⟨|sin γ|⟩ of each bed. Isotropic rods have a mean elevation of 32.7°; horizontal rods without a common heading have a nematic order of −0.5.</p>

<h2>Figure 1: filling</h2>
<figure><div class="row">
$(for ((n = 1; n <= ${#snapshots[@]} + 1; n++)); do
    echo "<div>"; image "$results/figure1_$n.png" "snapshot $n of the filling"
    echo "$(time_of_snapshot $n) s</div>"
  done)
</div>
<figcaption>Rods of λ = 30 without a limit on ω while they fill the vessel, and at the end, with the time modelled; seed $shown_seed. Only the lower 2 m
of the vessel, which is 10 m high, are drawn, seen level; rods that reach above are not drawn. Colours are those of figure 2.</figcaption></figure>

<h2>Figure 2: the bed of λ = 30</h2>
<figure><div class="pair">
$(for text in "" _cut; do
    for mode in study none; do
      echo "<div>"; image "$results/figure2_limits_$mode$text.png" "bed of aspect ratio 30"
      [ $mode = study ] && echo "limits of the study on ω</div>" || echo "no limit on ω</div>"
    done
  done)
</div>
<figcaption>Beds of λ = $shown_lambda after $total_time s, seed $shown_seed, coloured by the elevation of the axes, whole and, below, seen level without
the rods in front of the vessel's axis; pictures side by side have one scale. Only the lower $bed_top m of the vessel, which is 10 m high, are drawn.
The kinetic energy left in each is in the table of every bed.</figcaption></figure>

<h2>Figure 3: solid volume fraction against aspect ratio</h2>
<figure>
$(image "$results/figure3.png" "solid volume fraction against aspect ratio")
<figcaption>V_f of the inner cylinder, $over$error_bars. Solid line: Parkhouse and Kelly, 2 ln λ/λ. Dashed and dash-dotted: random
contacts for rods that lie horizontal and for isotropic ones; dotted, with bars: for the orientation of the beds themselves.
Hollow grey: values quoted from memory, not looked up in their source.
$(grep '^left out' "$work/figure3.txt" | sed 's/^left out: /Not shown: /; s/$/./' | escaped)</figcaption></figure>

<h2>Figure 4: orientation</h2>
<figure>
$(image "$results/figure4.png" "distribution of the elevation")
<figcaption>Rods per solid angle over that of isotropic rods, against the elevation of the axis above the horizontal.
$errors_of_figure4 Grey band: one standard deviation of as many isotropic rods as the smallest set in the panel has, that of
λ = 10 ($rods).</figcaption></figure>

<h2>Settings</h2>
$(table_of_settings)
<p>Lengths in m, times in s, stiffness in N/m (times λ), density in kg/m³, limits in rad/s. The study gives vessel, rods, density, friction,
limits and duration; stiffness, restitution and time step are ours, with reasons in <code>input/in.rods</code>.</p>

<h2>Commands</h2>
<p><code>scripts/report$([ $quick = no ] || echo " --quick")</code> does all this. By hand, for the bed shown, from the project's folder once it is built:</p>
<pre>$(commands)</pre>
<p><code>beds.csv</code> has a line a bed: λ, limits and seed, then columns of its <code>packing.csv</code> and <code>order.csv</code> and of the last
line of its <code>log.settle</code>. <code>elevation.csv</code> has the lines of every <code>orientation.csv</code> below one header, with λ, limits and seed
in front.</p>

<h2>Every bed</h2>
<div class="wide">
$(table_of_beds)
</div>
<p><i>Made from</i>: check sum of the decks and the plug-in's sources; those beside this report have $sources. <i>Measured by</i>: that
of the sources of <code>rod_packing</code> and <code>rod_orientation</code>; those beside this report have $measured_by.</p>

<h2>Published values in figure 3</h2>
<div class="wide">
$(table_of_literature)
</div>
</body>
</html>
HTML
}
