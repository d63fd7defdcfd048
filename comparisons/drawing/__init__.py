"""Plots, pictures and films of runs."""
