/* Compiles the Python of the archive beside Pyodide, by that Pyodide: the page starts sooner. */
import { readFileSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import { pathToFileURL } from "node:url";

const [folder, name] = process.argv.slice(2);
const { loadPyodide } = await import(pathToFileURL(join(folder, "pyodide.mjs")));
const python = await loadPyodide({ indexURL: `${folder}/` });
python.FS.writeFile("/plain.zip", readFileSync(join(folder, name)));
python.runPython(`
import compileall, zipfile
from pathlib import Path
from py_compile import PycInvalidationMode

with zipfile.ZipFile("/plain.zip") as plain:
    names = plain.namelist()
    plain.extractall("/gark")
unchecked = PycInvalidationMode.UNCHECKED_HASH
assert compileall.compile_dir("/gark", quiet=1, legacy=True, invalidation_mode=unchecked)
with zipfile.ZipFile("/compiled.zip", "w", zipfile.ZIP_DEFLATED, compresslevel=9) as compiled:
    for name in names:
        kept = name + "c" if name.endswith(".py") else name
        info = zipfile.ZipInfo(kept, (1980, 1, 1, 0, 0, 0))
        info.compress_type = zipfile.ZIP_DEFLATED
        compiled.writestr(info, (Path("/gark") / kept).read_bytes())
`);
writeFileSync(join(folder, name), python.FS.readFile("/compiled.zip"));
