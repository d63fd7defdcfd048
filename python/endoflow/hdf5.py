"""h5py, or what to do without it."""

try:
    import h5py
except ImportError:
    raise ImportError(
        "endoflow needs h5py: install the Debian package python3-h5py, or `pip install h5py`", name="h5py"
    ) from None

__all__ = ["h5py"]
