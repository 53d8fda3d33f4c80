#!/bin/sh
# usage: amplitude_of_field.sh OUTPUT FILE [words of the keyword field]
# Writes an input that sets the variable amplitude: 1, a factor, where a gas field has an array of amplitudes, else 0, so
# that gas from a file fluctuates as the file says.
factor=0
# the name of an array stands at the beginning of a line, or after VECTORS
if grep -aqE '^(VECTORS )?fluctuation ' "$2"; then factor=1; fi
echo "variable amplitude index $factor" > "$1"
