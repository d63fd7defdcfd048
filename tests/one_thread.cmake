# ctest reads this before it runs a test: a test has the cores that its PROCESSORS say, and another one runs beside it.
set(ENV{OMP_NUM_THREADS} 1)
