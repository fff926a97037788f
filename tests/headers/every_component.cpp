// Compiled only to ask the build system for the flags of all components.
