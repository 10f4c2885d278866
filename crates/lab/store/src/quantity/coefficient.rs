//! A coefficient of the equations that are fitted to a cell, in the units of the data.

super::quantities! {
    CELL "cell" NUMBER "name of the cell";
    TERM "term" NUMBER "the term";
    IMAGINARY "imaginary" NUMBER "1 for the imaginary part";
    VALUE "value" MIXED "the coefficient";
    ERROR "error" MIXED "standard error from the expected information";
    ROBUST_ERROR "robust_error" MIXED "standard error from the scatter of the scores";
    LOW "low" MIXED "lower end of the 95 % interval";
    HIGH "high" MIXED "upper end of the 95 % interval";
    WEAK_FORM "weak_form" MIXED "the coefficient by the weak form, a check of sign and size; none where noise makes the rates";
}
