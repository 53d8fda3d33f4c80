#!/bin/sh
# usage: amplitude_of_field.sh OUTPUT FILE [words of the keyword field]
# Writes 1, a factor, where a gas field has an array of amplitudes, else 0: gas from a file fluctuates as the file says.
factor=0
# the name of an array stands at the beginning of a line, or after VECTORS
if grep -aqE '^(VECTORS )?fluctuation ' "$2"; then factor=1; fi
echo "$factor" > "$1"
