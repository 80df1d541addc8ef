// Unreal's header tool writes this file; among other things it names the base class.

#pragma once

#define Super AActor
