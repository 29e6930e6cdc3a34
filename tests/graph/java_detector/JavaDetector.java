import goalmouth.candidates_t;
import goalmouth.post_t;
import goalmouth.posts_t;
import goalmouth.status_t;
import java.util.ArrayList;
import java.util.Arrays;
import java.util.HashMap;
import java.util.List;
import java.util.Map;
import lcm.lcm.LCM;
import lcm.lcm.LCMDataInputStream;

/**
 * A goalpost detector that owes nothing to goalmouth but its messages: edge points that stand above each other form a side, and a
 * left side with the next right side is a post.
 */
public final class JavaDetector {
    private static final float SAME_SIDE_PX = 8;      // gap in x that separates two sides
    private static final int FEWEST_POINTS = 6;       // of a side
    private static final double POST_WIDTH_M = 0.10;
    private static final double EDGE_SIGMA_PX = 1.0;

    /** Points of one side: their median x, and how far up and down they go. */
    private record Side(double x, double top, double base, int points) {}

    private final LCM lcm;
    private final Map<String, String> channels = new HashMap<>();
    private final status_t status = new status_t();

    private JavaDetector(Map<String, String> options) throws Exception {
        lcm = new LCM(options.getOrDefault("--lcm-url", ""));
        status.process = options.getOrDefault("--name", "detection");
        status.executable = "java_detector";
        status.pid = (int) ProcessHandle.current().pid();
        status.state = status_t.STARTING;
    }

    private static List<Side> sides(float[] x, float[] y) {
        Integer[] order = new Integer[x.length];
        Arrays.setAll(order, i -> i);
        Arrays.sort(order, (a, b) -> Float.compare(x[a], x[b]));
        List<Side> sides = new ArrayList<>();
        int start = 0;
        for (int i = 1; i <= order.length; i++) {
            if (i < order.length && x[order[i]] - x[order[i - 1]] <= SAME_SIDE_PX) {
                continue;
            }
            if (i - start >= FEWEST_POINTS) {
                double top = Double.MAX_VALUE;
                double base = -Double.MAX_VALUE;
                for (int k = start; k < i; k++) {
                    top = Math.min(top, y[order[k]]);
                    base = Math.max(base, y[order[k]]);
                }
                sides.add(new Side(x[order[(start + i) / 2]], top, base, i - start));
            }
            start = i;
        }
        return sides;
    }

    private static post_t post(candidates_t frame, Side left, Side right) {
        post_t post = new post_t();
        post.left_top = new double[] {left.x, left.top};
        post.left_base = new double[] {left.x, left.base};
        post.right_top = new double[] {right.x, right.top};
        post.right_base = new double[] {right.x, right.base};
        post.side = post_t.SIDE_UNKNOWN;
        post.width_px = right.x - left.x;
        post.distance_m = POST_WIDTH_M * frame.intrinsics.fx / post.width_px;
        post.bearing_rad = Math.atan((frame.intrinsics.cx - (left.x + right.x) / 2) / frame.intrinsics.fx);
        double distanceSigma = post.distance_m * Math.sqrt(2) * EDGE_SIGMA_PX / post.width_px;
        double bearingSigma = EDGE_SIGMA_PX / Math.sqrt(2) / frame.intrinsics.fx;
        post.covariance = new double[] {distanceSigma * distanceSigma, 0, 0, bearingSigma * bearingSigma};
        post.support_left = left.points;
        post.support_right = right.points;
        return post;
    }

    private synchronized void detect(LCMDataInputStream bytes) {
        try {
            candidates_t frame = new candidates_t(bytes);
            status.received++;
            List<post_t> found = new ArrayList<>();
            List<Side> rights = sides(frame.right_x, frame.right_y);
            for (Side left : sides(frame.left_x, frame.left_y)) {
                for (Side right : rights) {
                    double height = Math.min(left.base, right.base) - Math.max(left.top, right.top);
                    if (right.x > left.x + 1 && height > 2 * (right.x - left.x)) {
                        found.add(post(frame, left, right));
                        break;
                    }
                }
            }
            posts_t posts = new posts_t();
            posts.utime = frame.utime;
            posts.seq = frame.seq;
            posts.intrinsics = frame.intrinsics;
            posts.detector = "java_detector";
            posts.num_posts = found.size();
            posts.posts = found.toArray(new post_t[0]);
            lcm.publish(channels.getOrDefault("POSTS", "POSTS"), posts);
            status.published++;
        } catch (Exception notCandidates) {
            status.rejected++;
        }
    }

    private synchronized void report() {
        status.utime = System.currentTimeMillis() * 1000;
        status.latency_p50 = status.latency_p99 = -1;
        lcm.publish(channels.getOrDefault("STATUS", "STATUS"), status);
        status.state = status_t.RUNNING;
    }

    public static void main(String[] arguments) throws Exception {
        Map<String, String> options = new HashMap<>();
        Map<String, String> renamed = new HashMap<>();
        for (int i = 0; i + 1 < arguments.length; i += 2) {
            String[] pair = arguments[i + 1].split("=", 2);
            if (arguments[i].equals("--channel") && pair.length == 2) {
                renamed.put(pair[0], pair[1]);
            }
            options.put(arguments[i], arguments[i + 1]);
        }
        JavaDetector detector = new JavaDetector(options);
        detector.channels.putAll(renamed);
        String candidates = renamed.getOrDefault("CANDIDATES", "CANDIDATES");
        detector.lcm.subscribe(candidates, (lcm, channel, bytes) -> detector.detect(bytes));
        while (true) {
            detector.report();
            Thread.sleep(1000);
        }
    }
}
