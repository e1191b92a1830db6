// SPDX-License-Identifier: Apache-2.0
#include "app/machines/planned_line.hpp"

#include "app/machines/task_text.hpp"
#include "firmware/excavator/motion/program/task_program.hpp"

namespace graben::machines {

std::string line_refusal(const ExcavatorProfile& profile, const LineRequest& line) {
  ProgramRequest request;
  request.start = line.from;
  request.step_count = 1;
  StepRequest& step = request.step[0];
  step.kind = StepKind::kDig;
  step.to = line.to;
  step.speed_mps = line.speed_mps;
  step.duration_s = line.duration_s;
  ExcavatorProfile paced = profile;
  paced.line.acceleration_mps2 = line.acceleration_mps2;
  const ProgramResult result = plan_program(paced, request);
  return result.refusal == ProgramRefusal::kNone
             ? ""
             : refusal_words_of("line", profile, request, result);
}

}  // namespace graben::machines
