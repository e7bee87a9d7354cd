# Both decks of the page and what they need: rods.dump, spheres.dump, the decks of examples/multisphere.
PATH=$(dirname "$LMP"):$PATH
cp "$PROJECT"/examples/multisphere/in.* .
# The blocks of the page, one after the other.
awk '/^```/ { in_deck = /^```liggghts/; n += in_deck; next } in_deck { print >("in.deck_" n) }' \
  "$PROJECT/docs/from_multisphere.md"
cp in.deck_1 in.my_multisphere
sh ./rod_spheres.sh >rod.spheres
"$LMP" -in in.deck_2 >/dev/null
# The rods' deck with the data file in place of box and insertion.
sed -e 's/^create_box.*/read_data rods.data/' -e '/^region/d' \
    -e '/^fix rod /,/particles_in_region/d' in.deck_2 >in.my_rods
. ./example
