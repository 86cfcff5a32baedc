// Exists so that the targets of the precompiled headers have a source.
