import java.util.Map;
import java.util.Set;
import java.util.TreeMap;
import java.util.TreeSet;

import lcm.lcm.LCM;
import lcm.lcm.LCMDataInputStream;
import lcm.spy.LCMTypeDatabase;

/**
 * Decodes every channel as lcm-spy does: by the fingerprint of its messages, with the types found on the class path.
 *
 * JavaTypes SECONDS CHANNEL...: exit code 0 once every channel was decoded, 1 when the time is over. Prints "CHANNEL TYPE" for each.
 */
public final class JavaTypes {
    private final LCMTypeDatabase types = new LCMTypeDatabase();
    private final Map<String, String> decoded = new TreeMap<>();
    private final Map<String, String> failed = new TreeMap<>();

    private synchronized void receive(String channel, LCMDataInputStream message) {
        if (decoded.containsKey(channel)) {
            return;
        }
        try {
            long fingerprint = message.readLong();
            message.reset();
            Class<?> type = types.getClassByFingerprint(fingerprint);
            if (type == null) {
                throw new IllegalStateException("no type with fingerprint " + Long.toHexString(fingerprint));
            }
            type.getConstructor(java.io.DataInput.class).newInstance(message);
            if (message.available() != 0) {
                throw new IllegalStateException(message.available() + " bytes left over by " + type.getName());
            }
            decoded.put(channel, type.getName());
            failed.remove(channel);
        } catch (Exception e) {
            failed.put(channel, e.toString());
        }
        notifyAll();
    }

    private synchronized boolean waitFor(Set<String> channels, long seconds) throws InterruptedException {
        long end = System.nanoTime() + seconds * 1_000_000_000L;
        while (!decoded.keySet().containsAll(channels)) {
            long left = (end - System.nanoTime()) / 1_000_000L;
            if (left <= 0) {
                return false;
            }
            wait(left);
        }
        return true;
    }

    public static void main(String[] arguments) throws Exception {
        Set<String> expected = new TreeSet<>();
        for (int i = 1; i < arguments.length; i++) {
            expected.add(arguments[i]);
        }
        JavaTypes watcher = new JavaTypes();
        LCM lcm = new LCM(System.getenv("LCM_DEFAULT_URL"));
        lcm.subscribe(".*", (l, channel, message) -> watcher.receive(channel, message));
        boolean all = watcher.waitFor(expected, Long.parseLong(arguments[0]));
        synchronized (watcher) {
            watcher.decoded.forEach((channel, type) -> System.out.println(channel + " " + type));
            watcher.failed.forEach((channel, cause) -> System.out.println(channel + " NOT DECODED: " + cause));
            expected.removeAll(watcher.decoded.keySet());
            expected.forEach(channel -> System.out.println(channel + " MISSING"));
            System.exit(all ? 0 : 1);
        }
    }
}
