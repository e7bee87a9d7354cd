# The examples with few rods and steps: what stands first on the command line holds.
mkdir -p prefix/bin prefix/lib
PREFIX=$PWD/prefix
cp "$LIBRARY" prefix/lib
for program in "$LMP" "$(command -v liggghts)"; do
  short=prefix/bin/$(basename "$program")
  cat >$short <<END
#!/bin/sh
few="-var fill_time 0.0004 -var total_time 0.0008"
case "\$*" in *gentle*) few= ;; esac   # layers take their time
exec $program -var rods 20 \$few "\$@"
END
  chmod +x $short
done
PATH=$PREFIX/bin:$PATH
. ./example
