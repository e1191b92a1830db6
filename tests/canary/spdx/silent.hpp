#pragma once
/// A part without a licence.
