"""Reader of curve files in any of the known layouts."""

from pathlib import Path

from .errors import CurveError
from .pcs import parse_pcs
from .pcs_steps import is_pcs_export
from .table import CurveTable
from .text import decode, read_bytes
from .tidy_csv import parse_tidy_csv


def read_curves(path: str | Path) -> CurveTable:
    """Traction curves from a file: tidy CSV (see `tidy_csv`) or a text export of a PCS machine (see `pcs`).

    The content decides, not the name of the file.

    **Arguments:**
    - `path`: the file.

    **Returns:** a `CurveTable`: arrays with one entry per point, in SI (slide-to-roll ratio, not %; Pa or N, m/s, K).

    **Raises:** `CurveError`, one paragraph with the file, the line and the column, for whatever cannot be read.
    """
    path = Path(path)
    raw = read_bytes(path)
    if is_pcs_export(raw.decode("utf-8", errors="replace")):
        return parse_pcs(_decode_pcs(raw), path)
    text = decode(raw, path)
    if not text.strip():
        raise CurveError(str(path), None, "", "an empty file", "a file with traction curves")
    return parse_tidy_csv(text, path)


def _decode_pcs(raw: bytes) -> str:
    """Text of an export in UTF-8, or else in Latin-1, for its degree signs may be in a Windows code page."""
    try:
        return raw.decode("utf-8-sig")
    except UnicodeDecodeError:
        return raw.decode("latin-1")
