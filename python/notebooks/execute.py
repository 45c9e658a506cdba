"""Executes the notebooks in this folder, without changing them: `python execute.py [NOTEBOOK ...]`.

Deletes the runs of an earlier execution first.
"""

import shutil
import sys
import time
from pathlib import Path

import nbformat
from nbclient import NotebookClient

here = Path(__file__).parent
shutil.rmtree(here / "runs", ignore_errors=True)
for path in [Path(name) for name in sys.argv[1:]] or sorted(here.glob("*.ipynb")):
    begun = time.monotonic()
    notebook = nbformat.read(path, as_version=4)
    NotebookClient(notebook, timeout=1200, resources={"metadata": {"path": str(path.parent)}}).execute()
    print(f"{path.name}: executed in {time.monotonic() - begun:.0f} s")
