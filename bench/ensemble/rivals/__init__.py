"""One file per family of programs. Each function prepares one program and returns the function of one timed run."""
