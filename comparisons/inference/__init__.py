"""Parameters from data: what a study asks, runs as smooth functions of parameters, fit, posterior, calibration, sensitivity."""
