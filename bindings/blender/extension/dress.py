"""The operator: dresses the character, with progress, Esc and undo."""

from __future__ import annotations

import bespoke
import bpy

from . import findings, inputs, results, troubleshooting, work
from .meshes import SceneError

# Seconds between two looks at a run.
_TICK = 0.1
# Seconds for a run that was stopped to end: usually a tenth of one.
_PATIENCE = 5.0


class _Running:
    """The run of this Blender, if there is one: the panel shows it, its button stops it."""

    run: work.Run | None = None
    inputs: inputs.Inputs | None = None


def running() -> work.Run | None:
    """For the panel."""
    return _Running.run


def finish(context: bpy.types.Context, given: inputs.Inputs, run: work.Run) -> list[bpy.types.Object]:
    """Makes objects of what a run has left, and fills the findings. The new objects.

    Errors: SceneError.
    """
    if run.defect is not None:
        raise run.defect
    results.check(given)
    if context.object is not None and context.object.mode != "OBJECT":
        bpy.ops.object.mode_set(mode="OBJECT")
    made: list[bpy.types.Object | None] = [None] * len(run.outcomes)
    along: list[bpy.types.Object] = []
    for index, outcome in enumerate(run.outcomes):
        if outcome.vertices is None:
            continue
        made[index], *others = results.write(context, given, index, outcome)
        along += others
        if not context.scene.bespoke.keep_results:
            for thing in (made[index], *others):
                results.remove_earlier(context.scene, thing)
    if given.task.asks_for_covered and any(made):
        results.mask_covered(given, run.outcomes)
    findings.tell(context.scene, given, run.outcomes, made)
    objects = [thing for thing in made if thing is not None]
    if objects:
        for thing in context.selected_objects:
            thing.select_set(False)
        for thing in (*objects, *along):
            thing.select_set(True)
        context.view_layer.objects.active = objects[-1]
    return objects


class BESPOKE_OT_dress(bpy.types.Operator):
    """Puts the garments on the other character: new objects on its armature, with no triangle through another"""

    bl_idname = "bespoke.dress"
    bl_label = "Dress"
    bl_options = {"UNDO"}

    _timer: bpy.types.Timer | None = None

    @classmethod
    def poll(cls, context: bpy.types.Context) -> bool:
        """One at a time."""
        if _Running.run is not None:
            cls.poll_message_set("it is running already; Esc stops it")
            return False
        return context.scene is not None

    def execute(self, context: bpy.types.Context) -> set[str]:
        """At once, for scripts: Blender waits meanwhile."""
        if (given := self._begin(context)) is None:
            return {"CANCELLED"}
        run = work.Run(given.task)
        _Running.run, _Running.inputs = run, given
        manager = context.window_manager
        manager.progress_begin(0, 100)
        try:
            run.work(lambda share, _: manager.progress_update(100 * share))
        finally:
            manager.progress_end()
            _Running.run = _Running.inputs = None
        return self._end(context, given, run)

    def invoke(self, context: bpy.types.Context, _event: bpy.types.Event) -> set[str]:
        """In the background, while one can look around."""
        if (given := self._begin(context)) is None:
            return {"CANCELLED"}
        _Running.run, _Running.inputs = work.Run(given.task), given
        _Running.run.start()
        self._timer = context.window_manager.event_timer_add(_TICK, window=context.window)
        context.window_manager.modal_handler_add(self)
        return {"RUNNING_MODAL"}

    def modal(self, context: bpy.types.Context, event: bpy.types.Event) -> set[str]:
        """Esc stops it; the rest of the window can be used."""
        run, given = _Running.run, _Running.inputs
        if run is None or given is None:
            self._leave(context)
            return {"CANCELLED"}
        if event.type == "ESC" and event.value == "PRESS":
            run.cancel()
            return {"RUNNING_MODAL"}
        if event.type != "TIMER":
            return {"PASS_THROUGH"}
        if not run.is_over:
            share, words = run.progress()
            context.workspace.status_text_set(f"Bespoke: {words}, {share:.0%}   [Esc] stops it")
            _redraw(context)
            return {"PASS_THROUGH"}
        self._leave(context)
        return self._end(context, given, run)

    def cancel(self, context: bpy.types.Context) -> None:
        """Blender itself ends it, as where another file is opened."""
        stop()
        self._leave(context)

    def _begin(self, context: bpy.types.Context) -> inputs.Inputs | None:
        try:
            return inputs.gather(context)
        except (SceneError, ImportError, bespoke.BespokeError, TypeError) as failure:
            self.report({"ERROR"}, str(failure))
            return None

    def _leave(self, context: bpy.types.Context) -> None:
        _Running.run = _Running.inputs = None
        if self._timer is not None:
            context.window_manager.event_timer_remove(self._timer)
            self._timer = None
        if context.workspace is not None:
            context.workspace.status_text_set(None)
        _redraw(context)

    def _end(self, context: bpy.types.Context, given: inputs.Inputs, run: work.Run) -> set[str]:
        if run.is_cancelled:
            self.report({"INFO"}, "stopped; nothing was changed")
            return {"CANCELLED"}
        try:
            made = finish(context, given, run)
        except SceneError as failure:
            self.report({"ERROR"}, str(failure))
            return {"CANCELLED"}
        failed = [(k, o) for k, o in enumerate(run.outcomes) if o.failure is not None]
        for index, outcome in failed:
            name, failure = given.task.garments[index].name, outcome.failure
            page = f"docs/{troubleshooting.PAGE}#{troubleshooting.anchor(failure.status)}"
            level = "ERROR" if outcome.vertices is None else "WARNING"
            self.report({level}, f"{name}: {failure.message} ({page})")
        if made and not failed:
            self.report({"INFO"}, f"dressed and verified: {', '.join(thing.name for thing in made)}")
        # Findings are something to undo, too.
        return {"FINISHED"}


class BESPOKE_OT_stop(bpy.types.Operator):
    """Stops the run, as Esc does; nothing is changed"""

    bl_idname = "bespoke.stop"
    bl_label = "Stop"
    bl_options = {"INTERNAL"}

    def execute(self, _context: bpy.types.Context) -> set[str]:
        """Stops it."""
        stop()
        return {"FINISHED"}


def stop() -> None:
    """Stops what runs."""
    if _Running.run is not None:
        _Running.run.cancel()


def _redraw(context: bpy.types.Context) -> None:
    for window in context.window_manager.windows:
        for area in window.screen.areas:
            if area.type == "VIEW_3D":
                area.tag_redraw()


_CLASSES = (BESPOKE_OT_dress, BESPOKE_OT_stop)


def register() -> None:
    """With the classes."""
    for each in _CLASSES:
        bpy.utils.register_class(each)


def unregister() -> None:
    """Without; a run is stopped. Blender may be about to end, so its thread is waited for."""
    if _Running.run is not None:
        _Running.run.cancel()
        _Running.run.wait(_PATIENCE)
    _Running.run = _Running.inputs = None
    for each in reversed(_CLASSES):
        bpy.utils.unregister_class(each)
