// The functions of OpenGL, for .cpp files of the GL folders alone: no header names a GL type, and no file
// that includes this one includes Qt.
#pragma once

#include <epoxy/gl.h>
