# A rod that turns freely: rod.data has it. Its rotational energy is told as it goes.
#   rotation       words of fix nve/spherocylinder
#   dt, steps, every
atom_style  spherocylinder
atom_modify map array
boundary    f f f
newton      off
communicate single vel yes
units       si
read_data   rod.data
neighbor     0.01 bin
neigh_modify delay 0

fix kn   all property/global kn peratomtypepair 1 1.0
fix kt   all property/global kt peratomtypepair 1 1.0
fix rest all property/global coefficientRestitution peratomtypepair 1 0.5
pair_style gran model linear tangential off surface spherocylinder
pair_coeff * *
timestep ${dt}
fix motion all nve/spherocylinder ${rotation}

compute turning all erotate/spherocylinder
variable time   equal step*dt
thermo_style  custom step v_time c_turning
thermo        ${every}
thermo_modify norm no lost error flush yes format float %.15g
run ${steps}
