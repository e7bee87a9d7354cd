# The 19 spheres of a rod of 10 mm x 100 mm.
awk 'BEGIN { for (k = -9; k <= 9; k++) print 0, 0, 0.005 * k, 0.005 }'
