export { poseWords, type PoseWords } from "@/shared/words/poseBasis";
