"""The table [catalogue] of a bearing's scene file. It is not a part of the scene: no result depends on it."""

from pathlib import Path

from ...makers.catalogue import Catalogue
from ..distributions import means_of
from ..overrides import Overrides, applied, as_texts
from ..reader import read_tables, scene_model
from .schema import CatalogueTable


def load_catalogue(source: str | Path, overrides: Overrides | None = None) -> Catalogue | None:
    """The catalogue data of a scene's bearing; `None` without a table [catalogue]. Arguments as for `load_scene`.

    **Raises:** `SceneError` as `load_scene`, which reports all errors of the table.
    """
    label, mapping = read_tables(source)
    texts = as_texts(overrides)
    model = scene_model(mapping, texts, label)
    raw, _ = applied(mapping, texts, model, label)
    table = means_of(raw, model, label)[0].get("catalogue")
    if table is None or "catalogue" not in model.model_fields:
        return None
    return Catalogue(**CatalogueTable.model_validate(table).model_dump())
