# Gas velocity of the sheared scene along x: w(s) = 1 + 2 s, s = |x - 0.03|/0.03
# x [m]  ux uy uz [m/s]
0.00 0 0 3
0.03 0 0 1
0.06 0 0 3
