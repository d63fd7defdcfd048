"""RO-Crate 1.1 metadata of a run's directory: what each file is, and the program, the case and the time that made them.

https://www.researchobject.org/ro-crate/specification/1.1/
"""

from comparisons.measures.metrics import flattened

#: What the files of a run are: name, title, media type.
FILES = (
    ("run.json", "Parameters, provenance, events and alarms of the run", "application/json"),
    ("history.csv", "One row for each accepted time step", "text/csv"),
    ("shapes.h5", "The membrane at output times", "application/x-hdf5"),
    ("fields.pvd", "Index of the fields of velocity and pressure, for ParaView", "application/xml"),
    ("log.txt", "Messages of the run", "text/plain"),
    ("movie.mp4", "The run as a film", "video/mp4"),
    ("report/report.html", "Page of the run", "text/html"),
)
FOLDERS = (("fields/", "Fields of velocity and pressure"), ("report/", "Plots and page of the run"))

CONTEXT = "https://w3id.org/ro/crate/1.1/context"
CONFORMS = "https://w3id.org/ro/crate/1.1"
LICENSE = "https://spdx.org/licenses/GPL-3.0-or-later"


def metadata(run, licence=None):
    """The content of ro-crate-metadata.json for an endoflow.Run, as a dict.

    licence: of the data, a URL; None leaves it to who publishes them.
    """
    record, provenance = run.record, run.record["provenance"]
    files = [entry for entry in FILES if (run.directory / entry[0]).is_file()]
    folders = [entry for entry in FOLDERS if (run.directory / entry[0]).is_dir()]
    parts = [{"@id": name} for name, *_ in (*files, *folders)]
    parameters = flattened(run.parameters)
    name = parameters.get("case.name", "run")
    root = {
        "@id": "./",
        "@type": "Dataset",
        "name": f"endoflow run “{name}”",
        "description": parameters.get("case.description") or f"A run of the {run.engine} engine",
        "datePublished": record.get("ended") or record.get("started") or "unknown",
        "hasPart": parts,
        "mentions": {"@id": "#run"},
        **({"license": {"@id": licence}} if licence else {}),
    }
    action = {
        "@id": "#run",
        "@type": "CreateAction",
        "name": f"endoflow run {run.engine}, ended as {record.get('exit_reason')}",
        "instrument": {"@id": "#endoflow"},
        "object": [{"@id": f"#parameter-{key}"} for key in parameters],
        "result": parts,
        "startTime": record.get("started"),
        "endTime": record.get("ended"),
        "actionStatus": f"http://schema.org/{'Completed' if record.get('state') == 'finished' else 'Failed'}ActionStatus",
    }
    software = {
        "@id": "#endoflow",
        "@type": "SoftwareApplication",
        "name": "endoflow",
        "softwareVersion": " ".join(filter(None, (provenance.get("version"), provenance.get("git")))),
        "license": {"@id": LICENSE},
    }
    entities = [
        {
            "@id": "ro-crate-metadata.json",
            "@type": "CreativeWork",
            "conformsTo": {"@id": CONFORMS},
            "about": {"@id": "./"},
        },
        root,
        {key: value for key, value in action.items() if value is not None},
        software,
        *(_file(run.directory / path, path, title, kind) for path, title, kind in files),
        *({"@id": path, "@type": "Dataset", "name": title} for path, title in folders),
        *(
            {"@id": f"#parameter-{key}", "@type": "PropertyValue", "name": key, "value": value}
            for key, value in parameters.items()
        ),
    ]
    return {"@context": CONTEXT, "@graph": entities}


def _file(path, name, title, kind):
    """The entity of a file."""
    return {"@id": name, "@type": "File", "name": title, "encodingFormat": kind, "contentSize": str(path.stat().st_size)}
