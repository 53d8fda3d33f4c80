"""What accuracy each second of computing buys: settings of an input script run, measured and weighed."""
