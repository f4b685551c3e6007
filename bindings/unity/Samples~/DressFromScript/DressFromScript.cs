// Dresses a character while the game runs, without a hitch: the fitting has threads of its own.
using System.Collections.Generic;
using Bespoke.Unity;
using UnityEngine;

/// <summary>Put it on any object, fill in the fields, and press play.</summary>
[AddComponentMenu("Bespoke/Dress From Script")]
public sealed class DressFromScript : MonoBehaviour
{
    [Tooltip("Innermost first")] public SkinnedMeshRenderer[] garments = new SkinnedMeshRenderer[0];
    [Tooltip("The body that they were made for")] public SkinnedMeshRenderer[] madeFor = new SkinnedMeshRenderer[0];
    [Tooltip("The body that is to wear them")] public SkinnedMeshRenderer[] wornBy = new SkinnedMeshRenderer[0];
    public Animator madeForAnimator;
    public Animator wornByAnimator;
    public Dials dials = new Dials();

    private GarmentRetarget retarget;

    private void Start()
    {
        retarget = new GarmentRetarget(garments, madeFor, wornBy, madeForAnimator, wornByAnimator, dials);
        retarget.Fitting.Start();
    }

    private void Update()
    {
        if (retarget == null)
        {
            return;
        }
        double share = retarget.Fitting.Progress(out string words);
        name = $"{words} {share:P0}";
        if (!retarget.Fitting.IsOver)
        {
            return;
        }
        if (retarget.Fitting.Defect != null)
        {
            Debug.LogError(retarget.Fitting.Defect);
        }
        for (int k = 0; k < retarget.Fitting.Outcomes.Count; k++)
        {
            retarget.Apply(k, new List<GameObject>());
            if (retarget.Fitting.Outcomes[k].Failure != null)
            {
                Debug.LogError(retarget.Fitting.Outcomes[k].Failure.Message, garments[k]);
            }
        }
        retarget = null;
    }

    private void OnDestroy()
    {
        retarget?.Fitting.Cancel();
    }
}
