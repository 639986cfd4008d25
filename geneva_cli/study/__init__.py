"""Studies of one or many designs: survey, sweep, comparison, synthesis, figures and reports."""
