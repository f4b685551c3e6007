// Rigs: joints in, the map out, pairs in every type of index, and what is refused.
using System;
using System.Collections.Generic;
using System.Linq;
using Bespoke;

internal static class Rigs
{
    public static void All()
    {
        Maps();
        Refusals();
        SkeletonsAndSkins();
        Outfits();
        KeyPoses();
    }

    // A jacket over a shirt, and what passes through what.
    private static void Outfits()
    {
        Inputs inputs = Inputs.Tube();
        float[] jacket = inputs.GarmentPositions;
        float[] shirt = jacket.Select((x, k) => k % 3 == 1 ? x : 0.8f * x).ToArray();
        using (Session session = new Session())
        {
            session.AddOutfitGarment(jacket, inputs.GarmentTriangles);
            session.ClearOutfit();
            Check.Same(session.ReadOutfitOrder().Length, 0, "garments of no outfit");
            session.AddOutfitGarment(jacket, inputs.GarmentTriangles);
            session.AddOutfitGarment(shirt, inputs.GarmentTriangles);
            Check.Same(string.Join(", ", session.ReadOutfitOrder()), "1, 0", "order");
            WornPair pair = session.ReadWornPairs().Single();
            Check.That(pair.Inner == 1 && pair.Outer == 0 && pair.Confidence > 0.5 && !pair.IsOverruled, "the pair");
            uint[] apart = session.FindIntersections(jacket, inputs.GarmentTriangles, shirt, inputs.GarmentTriangles);
            Check.Same(apart.Length, 0, "pairs of garments that are apart");
            float[] across = { -3f, 0.011f, -3f, 9f, 0.012f, -3f, -3f, 0.013f, 9f };
            int[] one = { 0, 1, 2 };
            uint[] cut = session.FindIntersections(jacket, inputs.GarmentTriangles, across, one);
            Check.That(cut.Length > 0 && cut.Where((t, k) => k % 2 == 1).All(t => t == 0), "a plane cuts the jacket");
            Check.Same(session.FindIntersections(jacket, inputs.GarmentTriangles).Length, 0, "pairs within the jacket");
            Check.Refused(
                Status.InvalidMesh, () => session.FindIntersections(jacket, inputs.GarmentTriangles, across, new[] { 0, 1, 7 }),
                "second mesh");
        }
    }

    private static void KeyPoses()
    {
        double[] still = Enumerable.Range(0, 7 * 16).Select(k => k % 16 % 5 == 0 ? 1.0 : 0.0).ToArray();
        using (Session session = new Session())
        {
            Check.Refused(Status.InvalidState, () => session.AddKeyPose(null, still), "target rig");
            session.SetTargetRig(Target());
            session.AddKeyPose("still", still);
            Check.Refused(Status.InvalidArgument, () => session.AddKeyPose(null, still.Take(32).ToArray()), "2 joints");
            Check.Refused(Status.InvalidArgument, () => session.AddKeyPose(null, still.Take(33).ToArray()), "33");
            Check.Refused(Status.InvalidState, () => session.SolvePoseCorrections(4), "result");
            Check.Refused(Status.InvalidState, () => session.ReadPoseCorrection(0), "still");
            session.ClearKeyPoses();
            Check.Refused(Status.InvalidArgument, () => session.ReadPoseCorrection(0), "key pose 0");
        }
    }

    // By names, in another order and with another naming; the caller's pairs win.
    private static void Maps()
    {
        using (Session session = new Session())
        {
            Check.Refused(Status.InvalidState, () => session.ReadJointMap(), "source rig");
            session.SetSourceRig(Source());
            session.SetTargetRig(Target());
            MappedJoint[] map = session.ReadJointMap();
            Check.Same(map.Length, 7, "joints");
            for (int k = 0; k < 7; k++)
            {
                Check.Same(map[k].Target, (int?)(6 - k), $"what joint {k} is mapped to");
                Check.Same(map[k].Reason, JointReason.Name, $"why joint {k} is");
                Check.That(map[k].Confidence > 0.5 && map[k].Confidence <= 1.0, $"joint {k}: {map[k].Confidence}");
            }
            string parts = string.Join(", ", map.Take(3).Select(joint => joint.Part));
            Check.Same(parts, "hips, left upper leg, left lower leg", "parts");

            session.SetJointPairs(new uint[] { 3, 4, 6, uint.MaxValue });
            Mended(session);
            session.SetJointPairs(new ushort[] { 3, 4, 6, ushort.MaxValue });
            Mended(session);
            session.SetJointPairs(new[] { 3, 4, 6, -1 });
            Mended(session);
            session.SetJointPairs(new int[0]);
            Check.Same(session.ReadJointMap()[3].Target, (int?)3, "what is mapped without pairs");
        }
    }

    private static void Mended(Session session)
    {
        MappedJoint[] map = session.ReadJointMap();
        Check.That(map[3].Target == 4 && map[3].Reason == JointReason.Caller && map[3].Confidence == 1.0, "a pair");
        Check.That(map[6].Target == null && map[6].Reason == JointReason.Caller, "a pair with nothing");
    }

    private static void Refusals()
    {
        using (Session session = new Session())
        {
            Check.Throws<ArgumentNullException>(() => session.SetSourceRig(null));
            Check.Refused(Status.InvalidState, () => session.ReadAddedJoints(), "result");
            Check.Refused(Status.InvalidState, () => session.ReadPoseTransforms(), "target rig");
            Check.Throws<ArgumentNullException>(() => session.SetSourceRig(new Joint[1]));
            Check.Refused(Status.InvalidSkeleton, () => session.SetTargetRig(new Joint[0]), "target rig");
            Changed(session, joint => joint.Bind = null, Status.InvalidArgument, "joint 2", "none");
            Changed(session, joint => joint.Bind = new double[12], Status.InvalidArgument, "joint 2", "12");
            Changed(session, joint => joint.Bind[13] = double.NaN, Status.InvalidSkeleton, "joint 2 (\"LeftLeg\")");
            Changed(session, joint => joint.Parent = -1, Status.InvalidSkeleton, "joint 2", "-1");
            Changed(session, joint => joint.Parent = 70, Status.InvalidSkeleton, "joint 2", "70");
            Changed(session, joint => joint.Parent = 3, Status.InvalidSkeleton, "circle");
            Check.Refused(Status.InvalidArgument, () => session.SetJointPairs(new int[3]), "joint pairs", "3");
            int[] joints = { 0, -1 };
            float[] weights = { 1f, 1f };
            Status bad = Status.InvalidWeights;
            Check.Refused(bad, () => session.SetSourceSkinInfluences(joints, weights, 1, 3), "source skin", "-1");
            Check.Refused(bad, () => session.SetGarmentSkinInfluences(joints, weights, 1, 3), "garment skin", "-1");
            Check.Throws<ArgumentOutOfRangeException>(() => session.SetGarmentSkinInfluences(joints, weights, 0, 3));
            session.SetSourceRig(Source());
            session.SetTargetRig(Target());
            session.SetJointPairs(new[] { 0, 9 });
            Check.Refused(Status.InvalidArgument, () => session.ReadJointMap(), "joint 9 of the target rig");
        }
    }

    private static void Changed(Session session, Action<Joint> change, Status status, params string[] words)
    {
        Joint[] joints = Source();
        change(joints[2]);
        Check.Refused(status, () => session.SetSourceRig(joints), words);
    }

    // A skeleton beside a rig is a rig without names; the skeleton takes the rig's place, and the other way round.
    private static void SkeletonsAndSkins()
    {
        Inputs inputs = Inputs.Tube();
        int vertices = inputs.GarmentPositions.Length / 3;
        using (Session session = inputs.Session())
        {
            session.SetSourceRig(new List<Joint> { At(null, null, 0, 0), At("", 0, 0, -1), At(null, 0, 0, 1) });
            Check.Same(session.ReadJointMap().Length, 3, "joints");
            int[] joints = Enumerable.Range(0, 2 * vertices).Select(k => k % 2).ToArray();
            float[] weights = Enumerable.Repeat(0.5f, 2 * vertices).ToArray();
            session.SetSourceSkinInfluences(joints, weights, 2, 3);
            session.SetGarmentSkinInfluences(joints, weights, 2, 3);
            session.ReadJointMap();
            session.SetGarmentSkinInfluences(joints, weights, 2, 4);
            Check.Refused(Status.InvalidWeights, () => session.Prepare(), "garment skin weights");
            session.SetSourceSkeleton(inputs.SourceJoints, inputs.Bones);
            session.Run();
            Check.Same(session.Stage, Stage.Done, "stage");
        }
    }

    private static Joint[] Source()
    {
        return Rig(1.0, "Hips", "LeftUpLeg", "LeftLeg", "LeftFoot", "RightUpLeg", "RightLeg", "RightFoot");
    }

    // In the opposite order.
    private static Joint[] Target()
    {
        Joint[] joints = Rig(
            1.3, "hips", "leftUpperLeg", "leftLowerLeg", "leftFoot", "rightUpperLeg", "rightLowerLeg", "rightFoot");
        foreach (Joint joint in joints)
        {
            joint.Parent = 6 - joint.Parent;
        }
        return joints.Reverse().ToArray();
    }

    // Two legs.
    private static Joint[] Rig(double scale, params string[] names)
    {
        Joint[] joints = new Joint[names.Length];
        joints[0] = At(names[0], null, 0, scale);
        for (int k = 1; k < joints.Length; k++)
        {
            int down = (k - 1) % 3;
            joints[k] = At(
                names[k], down == 0 ? 0 : k - 1, scale * (k < 4 ? 0.1 : -0.1), scale * (0.95 - 0.45 * down));
        }
        return joints;
    }

    private static Joint At(string name, int? parent, double x, double y)
    {
        return new Joint(name, parent, new[] { 1.0, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, x, y, 0, 1 });
    }
}
