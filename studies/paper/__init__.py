"""What studies/reproduce_paper runs: cases, theory to compare with, claims, figures, page."""
