/* The CSV files of data/ as read-only bytes: spectra_NAME_begin .. spectra_NAME_end. */

.macro table name, file
  .global spectra_\name\()_begin
  .global spectra_\name\()_end
spectra_\name\()_begin:
  .incbin "\file"
spectra_\name\()_end:
.endm

  .section .rodata
  table cie1931, "cie1931.csv"
  table cie1964, "cie1964.csv"
  table alpha_opic, "alpha_opic.csv"
  table lamp_metrics, "lamp_metrics.csv"
  table illuminants, "illuminants.csv"
  table houser_lamps, "houser_lamps.csv"
  table munsell_nickerson, "munsell_nickerson.csv"
  table munsell_renotation, "munsell_renotation.csv"

  .section .note.GNU-stack, "", %progbits
