# The Python package by pip, from the wheel alone. The program is that of its README.
set -eu
mkdir /home/python
cd /home/python
python3 -m venv venv
venv/bin/pip install --quiet /artefacts/muslin-*.whl
venv/bin/python -c 'from importlib.metadata import metadata; print(metadata("muslin")["Description"])' > README.md
awk '/^```py$/ { inside = 1; next } /^```/ { inside = 0 } inside' README.md > main.py
venv/bin/python main.py | tee output.txt
grep -q '1600 vertices' output.txt
echo "first frame: Python by pip, $(grep -c . main.py) lines"
